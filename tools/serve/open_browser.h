#pragma once

#include <filesystem>
#include <string>

namespace talus {

/// Whether the program runs in a terminal of a desktop: standard output is a terminal, and DISPLAY or WAYLAND_DISPLAY
/// is set.
bool on_desktop();

/// A page that the desktop's browser is made to open.
class BrowserPage {
 public:
  /// Starts `xdg-open` and does not wait for it; where there is none, nothing happens. Other users can read command
  /// lines, so it is given a file that leads to `url` and that only this user can read.
  explicit BrowserPage(const std::string& url);
  /// Removes the file.
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

 private:
  std::filesystem::path file_;  // empty: none
};

}  // namespace talus
