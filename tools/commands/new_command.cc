#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "common/text/file.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"

namespace talus {
namespace {

constexpr const char* flat_scene =
    "# All keys: docs/scenes.md or `talus reference`. Examples: docs/tutorial.md.\n"
    "title = \"A pile of boxes and discs\"\n"
    "dimension = 2\n"
    "\n"
    "# What there is: metres, kilograms. docs/scenes.md lists the other kinds of shapes.\n"
    "[shape.box]\n"
    "kind = \"box\"\n"
    "size = [0.8, 0.8]\n"
    "friction = 0.6\n"
    "\n"
    "[shape.disc]\n"
    "kind = \"ball\"\n"
    "radius = 0.5\n"
    "rolling_friction = 0.1 # without it they roll on and on\n"
    "\n"
    "# Where bodies come from: 4 a second from 12 m up, at most 60.\n"
    "[[source]]\n"
    "shape = [\"box\", \"disc\"]\n"
    "position = [0.0, 12.0]\n"
    "velocity = [0.0, -8.0]\n"
    "rate = 4\n"
    "count = 60\n"
    "\n"
    "# Bodies that are there from the start: a wall of three layers.\n"
    "[[body]]\n"
    "shape = \"box\"\n"
    "position = [7.6, 0.4]\n"
    "repeat = [2, 3]\n"
    "step = [0.85, 0.8]\n"
    "\n"
    "# What no body moves.\n"
    "[[obstacle]]\n"
    "kind = \"box\"\n"
    "size = [6.0, 0.5]\n"
    "position = [-6.0, 2.0]\n"
    "angle_deg = -30\n"
    "\n"
    "[run]\n"
    "until = \"rest\"\n"
    "frames = 900 # at most: 30 s\n";

constexpr const char* space_scene =
    "# All keys: docs/scenes.md or `talus reference`. Examples: docs/tutorial.md.\n"
    "title = \"A pile of boxes and balls\"\n"
    "dimension = 3\n"
    "\n"
    "# What there is: metres, kilograms. docs/scenes.md lists the other kinds of shapes.\n"
    "[shape.box]\n"
    "kind = \"box\"\n"
    "size = [0.8, 0.8, 0.8]\n"
    "friction = 0.6\n"
    "\n"
    "[shape.ball]\n"
    "kind = \"ball\"\n"
    "radius = 0.5\n"
    "rolling_friction = 0.1 # without it they roll on and on\n"
    "\n"
    "# Where bodies come from: 4 a second from 12 m up, at most 60.\n"
    "[[source]]\n"
    "shape = [\"box\", \"ball\"]\n"
    "position = [0.0, 0.0, 12.0]\n"
    "velocity = [0.0, 0.0, -8.0]\n"
    "rate = 4\n"
    "count = 60\n"
    "\n"
    "# Bodies that are there from the start: a wall of three layers.\n"
    "[[body]]\n"
    "shape = \"box\"\n"
    "position = [6.0, -1.3, 0.4]\n"
    "repeat = [1, 4, 3]\n"
    "step = [0.0, 0.85, 0.8]\n"
    "\n"
    "# What no body moves.\n"
    "[[obstacle]]\n"
    "kind = \"box\"\n"
    "size = [6.0, 4.0, 0.5]\n"
    "position = [-6.0, 0.0, 2.0]\n"
    "angle_deg = 30\n"
    "axis = [0, 1, 0]\n"
    "\n"
    "[run]\n"
    "until = \"rest\"\n"
    "frames = 900 # at most: 30 s\n";

void write_new_scene(const std::string& name, int dimension) {
  std::filesystem::path file = name;
  if (file.extension() != ".toml") file += ".toml";
  if (std::filesystem::exists(file))
    throw std::invalid_argument(fmt::format("NAME = {}: must be new; nothing is overwritten", file.string()));
  write_file(file, dimension == 2 ? flat_scene : space_scene);
  print_result("{0}: now `talus run {0}`\n", printable(file.string()));
}

}  // namespace

void add_new_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("new", "Write a scene with comments to begin with");
  auto name = std::make_shared<std::string>();
  auto dimension = std::make_shared<int>(2);
  command->add_option("NAME", *name, "File to write; .toml is added")->required()->check(in_a_folder());
  command->add_option("--dimension", *dimension, "2 or 3")->check(CLI::IsMember({2, 3}))->capture_default_str();
  command->callback([=, &exit_code] {
    write_new_scene(*name, *dimension);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
