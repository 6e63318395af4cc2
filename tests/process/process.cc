#include "tests/process/process.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace talus {

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Outcome shell(const std::string& script) {
  const TemporaryFolder folder;
  std::ofstream(folder / "script") << "export TALUS='" TALUS_COMMAND "'\ncd '" TALUS_SOURCE "'\n" << script << '\n';
  const std::string line =
      "bash " + (folder / "script") + " </dev/null >" + (folder / "out") + " 2>" + (folder / "err");
  const int status = std::system(line.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(folder / "out"),
                  contents(folder / "err")};
  return outcome;
}

Outcome talus_command(const std::string& arguments) { return shell("\"$TALUS\" " + arguments); }

void record_with_event(const std::string& folder) {
  const std::string scene = folder + ".toml";
  std::ofstream(scene) << R"(
title = "Ten discs that are woken"
dimension = 2
shape.disc = {kind = "ball", radius = 0.5}
run = {frames = 60}
[[source]]
position = [0, 8]
velocity = [0, -7]
count = 10
[[pile]]
[[event]]
time = 1.0
do = "wake"
)";
  const Outcome outcome = talus_command("run " + scene + " --no-telemetry --out " + folder);
  if (outcome.exit_code != 0) throw std::runtime_error(outcome.err);
}

}  // namespace talus
