
#include "common/scene/read_scene.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/output/output.h"
#include "tools/run/find_scene.h"

namespace talus {
namespace {

int list_scenes() {
  int exit_code = exit_codes::success;
  for (const std::filesystem::path& file : scene_files()) {
    try {
      const auto scene = read_scene(file, {});
      std::visit(
          [&](const auto& of_dimension) {
            print_result("{:26} {}\n", printable(file.stem().string()), printable(of_dimension.title));
          },
          scene);
    } catch (const SceneErrors& errors) {
      print_result("{:26} not readable: {}\n", printable(file.stem().string()), printable_lines(errors.what()));
      exit_code = exit_codes::bad_input;
    }
  }
  return exit_code;
}

}  // namespace

void add_list_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("list", "Show the scenes, a line each");
  command->callback([&exit_code] { exit_code = list_scenes(); });
}

}  // namespace talus
