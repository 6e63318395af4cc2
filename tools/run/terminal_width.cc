#include "tools/run/terminal_width.h"

#include <sys/ioctl.h>

namespace talus {

int terminal_width(int file_descriptor) {
  constexpr int usual_width = 80;
  winsize size{};
  if (ioctl(file_descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual_width;
  return size.ws_col;
}

}  // namespace talus
