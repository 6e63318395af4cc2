#pragma once

#include <memory>

#include "tools/monitor/sheet.h"

namespace talus {

/// The whole terminal, from construction to destruction: it shows sheets and gives keys. Colours where the terminal has
/// them and NO_COLOR is not set; blocks and lines as ASCII where the locale is not UTF-8. One at a time.
class TerminalScreen {
 public:
  /// nullptr where standard output or input is no terminal, or one of a kind that cannot show a screen.
  static std::unique_ptr<TerminalScreen> open();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;
  ~TerminalScreen();

  static int rows();
  static int columns();
  void show(const Sheet& sheet);

  static constexpr int no_key = -1;
  static constexpr int resized = -2;
  /// The next key pressed, as in pages.h; at once.
  static int key();

 private:
  TerminalScreen();

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus
