#include "tools/serve/open_browser.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace talus {
namespace {

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

/// A folder of this user's files that go with the session, else that of temporary ones.
std::filesystem::path session_folder() {
  std::error_code unused;
  if (is_set("XDG_RUNTIME_DIR") && std::filesystem::is_directory(std::getenv("XDG_RUNTIME_DIR"), unused))
    return std::getenv("XDG_RUNTIME_DIR");
  return std::filesystem::temp_directory_path();
}

bool write_all(int file, std::string_view text) {
  return write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

}  // namespace

bool on_desktop() { return isatty(STDOUT_FILENO) == 1 && (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")); }

BrowserPage::BrowserPage(const std::string& url) {
  constexpr std::string_view ending = ".html";
  std::string name = (session_folder() / "talus-view-XXXXXX").string();
  name += ending;
  const int file = mkstemps(name.data(), static_cast<int>(ending.size()));  // of mode 0600
  if (file < 0) return;
  file_ = name;
  const bool written = write_all(
      file, fmt::format("<!DOCTYPE html><title>talus</title><meta http-equiv=\"refresh\" content=\"0; url={0}\">"
                        "<a href=\"{0}\">talus view</a>\n",
                        url));
  close(file);
  if (!written) return;
  std::string program = "sh";
  std::string option = "-c";
  std::string script = "command -v xdg-open >/dev/null && { xdg-open \"$0\" >/dev/null 2>&1 </dev/null & }";
  const std::array<char*, 5> arguments = {program.data(), option.data(), script.data(), name.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ) == 0)
    waitpid(child, nullptr, 0);
}

BrowserPage::~BrowserPage() {
  std::error_code unused;
  if (!file_.empty()) std::filesystem::remove(file_, unused);
}

}  // namespace talus
