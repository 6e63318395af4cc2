
#include "common/scene/read_scene.h"
#include "common/scene/spout_rate.h"
#include "common/scene/typical_body.h"
#include "common/scene/warnings.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"

#ifdef TALUS_LCM
#include "lcmtypes/translate.h"
#endif

namespace talus {
namespace {

template <int Dim>
void print_report(const Scene<Dim>& scene) {
  const TypicalBody body = typical_body(scene);
  print_result("{}\n", printable(scene.title));
  print_result("  {}D, {} steps of {:.6g} s ({} frames at {:g} a second){}, policy {}\n", Dim, scene.steps(),
               scene.world.dt, scene.run.frames, scene.run.frame_rate,
               scene.run.until == until_rest ? " or until rest" : "", scene.policy.kind);
  if (!scene.bodies.empty()) print_result("  {} bodies from the start\n", scene.bodies.size());
  print_result("  bodies of {:.4g} kg in the mean, bounding volume {:.4g} {}, largest extent {:.4g} m\n", body.mass,
               body.bounding_volume, Dim == 2 ? "m^2" : "m^3", body.extent);
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const Source<Dim>& source = scene.sources[i];
    print_result("  source[{}]: {} bodies at {:g} a second from {:g} s on; its spout reaches {:.3g} a second\n", i,
                 source.count, source.rate, source.start, reachable_rate(source, scene.world));
  }
  for (const std::string& warning : warnings(scene)) print_result("  warning: {}\n", printable(warning));
  for (const std::string& backend : backends(Dim))
    for (const std::string& warning : engine_warnings(scene, engine_traits<Dim>(backend)))
      print_result("  warning: {}: {}\n", backend, printable(warning));
}

/// Builds what a run would build on each engine of this build, where the scene lies in the engine's window or `force`
/// is given: `check` refuses what every one of them refuses.
template <int Dim>
void try_engines(const Scene<Dim>& scene, const std::string& file, bool force) {
  const std::vector<std::string> engines = backends(Dim);
  std::string refusals;
  std::size_t refused = 0;
  for (const std::string& backend : engines) {
    try {
      for (const SceneError& each : check_window(scene, backend, file, force))
        print_message("warning: {}{}", outside_prefix, to_string(each));
      make_simulation(scene, backend);
    } catch (const std::invalid_argument& refusal) {
      refusals += fmt::format("{}{}: {}: {}", refused == 0 ? "" : "\n", file, backend, refusal.what());
      ++refused;
    }
  }
  if (refused > 0 && refused == engines.size()) throw std::invalid_argument(refusals);
  if (refused > 0) print_result("{}\n", refusals);
}

#ifdef TALUS_LCM
/// A run records and sends its shapes: refuses one that no message can hold.
template <int Dim>
void try_messages(const Scene<Dim>& scene, const std::string& file) {
  try {
    to_shapes<Dim>(scene.world);
  } catch (const std::invalid_argument& refusal) {
    throw std::invalid_argument(fmt::format("{}: {}", file, refusal.what()));
  }
}
#endif

int check_scene(const std::string& name, const std::vector<std::string>& settings, bool force) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back({setting});
  const std::filesystem::path file = find_scene(name);
  const AnyScene scene = read_scene(file, overrides);
  std::visit([&](const auto& of_dimension) { try_engines(of_dimension, file.string(), force); }, scene);
#ifdef TALUS_LCM
  std::visit([&](const auto& of_dimension) { try_messages(of_dimension, file.string()); }, scene);
#endif
  print_result("{}: OK\n", printable(file.string()));
  std::visit([](const auto& of_dimension) { print_report(of_dimension); }, scene);
  return exit_codes::success;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("check", "Read a scene without running it: all its errors, or what it will do");
  auto scene = std::make_shared<std::string>();
  auto settings = std::make_shared<std::vector<std::string>>();
  command->add_option("scene", *scene, "Scene file, or the name of a scene that `talus list` shows")->required();
  command->add_option("-s,--set", *settings, "Replace a value of the scene, as policy.tau=0.4; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  auto force = std::make_shared<bool>(false);
  command->add_flag("-f,--force", *force,
                    "Accept the scene outside of the window in which results hold too, as `talus run` does");
  command->callback([=, &exit_code] { exit_code = check_scene(*scene, *settings, *force); });
}

}  // namespace talus
