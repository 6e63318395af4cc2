#include "tools/plot/plot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tools/plot/gnuplot_script.h"

namespace talus {

namespace {

/// A folder of its own for one call, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "talus_plot_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("cannot make a folder in " + std::filesystem::temp_directory_path().string());
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs gnuplot with its output and errors in files; returns its exit status. Without a shell, so that no name needs
/// quoting.
int run_gnuplot(std::string script, const std::string& output, const std::string& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string program = "gnuplot";
  std::string defaults_off = "-d";  // a user's own ~/.gnuplot would change the style
  const std::array<char*, 4> arguments = {program.data(), defaults_off.data(), script.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) {
    throw std::runtime_error("plots need gnuplot, which is not on this machine: apt-get install gnuplot-nox");
  }
  if (failure != 0) {
    throw std::runtime_error(std::string("cannot start gnuplot: ") + std::strerror(failure));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

std::string svg_of(const Plot& plot) {
  check(plot);
  const TemporaryFolder folder;
  const std::string script = folder / "plot.gp";
  std::ofstream(script) << gnuplot_script(plot);
  const int status = run_gnuplot(script, folder / "plot.svg", folder / "errors");
  std::string svg = text_of(folder / "plot.svg");
  if (status != 0 || svg.find("</svg>") == std::string::npos) {
    throw std::runtime_error("gnuplot could not draw \"" + plot.title + "\": " + text_of(folder / "errors"));
  }
  return svg;
}

}  // namespace talus
