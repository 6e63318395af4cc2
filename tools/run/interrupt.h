#pragma once

namespace talus {

/// From construction on, Ctrl-C and SIGTERM ask the run to end instead of killing it; a second one kills.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const;
};

}  // namespace talus
