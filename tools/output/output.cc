#include "tools/output/output.h"

#include <fcntl.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "common/text/printable.h"

namespace talus {
namespace {

[[noreturn]] void results_failed(int error) {
  throw std::system_error(error == 0 ? EIO : error, std::generic_category(), "standard output");
}

}  // namespace

void prepare_output() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    // open() takes the lowest free number, which is this one. Read-only: a write must fail, as on a closed stream.
    if (fcntl(descriptor, F_GETFD) == -1) static_cast<void>(open("/dev/null", O_RDONLY));
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void print_text(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) results_failed(errno);
}

void flush_results() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) results_failed(errno);
}

void write_note(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void write_message(std::string_view line) { write_note(printable_lines(line) + '\n'); }

int terminal_width(int file_descriptor) {
  constexpr int usual_width = 80;
  winsize size{};
  if (ioctl(file_descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual_width;
  return size.ws_col;
}

}  // namespace talus
