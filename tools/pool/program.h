#pragma once

#include <string>
#include <vector>

namespace talus {

struct ProgramEnd {
  int exit_code = 0;  // 127 where there is no such program, 128 + signal for one that was killed
  std::string out;    // standard output
};

/// Runs a program of the search path with arguments, waits for its end and reads its standard output. Without a shell,
/// so that nothing needs quoting. Throws std::system_error where no process can be made.
ProgramEnd run_program(std::vector<std::string> words);

}  // namespace talus
