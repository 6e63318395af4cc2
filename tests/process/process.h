#pragma once
// Runs the talus command as a user would.

#include <filesystem>
#include <string>

#include "tests/common/temporary_folder.h"

namespace talus {

struct Outcome {
  int exit_code = 0;  // as a shell tells it: 128 + signal for a process that was killed
  std::string out;    // standard output
  std::string err;    // standard error
};

/// Runs `talus ARGUMENTS` in a shell, standard input empty.
Outcome talus_command(const std::string& arguments);

/// Runs a shell script in which $TALUS is the command.
Outcome shell(const std::string& script);

/// Records a pour of ten discs in the folder; an event wakes all of them after a second.
void record_with_event(const std::string& folder);

/// The whole of a file.
std::string contents(const std::filesystem::path& file);

}  // namespace talus
