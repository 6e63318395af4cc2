#pragma once

namespace talus {

/// Columns of the terminal behind a file descriptor; 80 where it is unknown.
int terminal_width(int file_descriptor);

}  // namespace talus
