#pragma once
// Runs the talus command as a user would.

#include <filesystem>
#include <string>

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

/// A new empty folder that goes when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// The whole of a file.
std::string contents(const std::filesystem::path& file);

}  // namespace talus
