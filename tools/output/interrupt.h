#pragma once

namespace talus {

/// While it exists, Ctrl-C, SIGTERM and SIGHUP (the terminal was closed) end the run in good order; the second signal
/// kills. A SIGHUP that is ignored, as under nohup, stays ignored. In a process that was forked while one existed, a
/// new one also has what arrived before it.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const;
};

}  // namespace talus
