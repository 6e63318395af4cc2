#include <algorithm>
#include <memory>

#include "common/scene/accuracy.h"
#include "common/scene/read_scene.h"
#include "common/scene/spout_rate.h"
#include "common/scene/typical_body.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/scene_options.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"

#ifdef TALUS_LCM
#include "lcmtypes/shapes_message.h"
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
  print_result("  {}\n", accuracy_text(scene));
  if (!scene.bodies.empty()) print_result("  {} bodies from the start\n", scene.bodies.size());
  print_result("  bodies of {:.4g} kg in the mean, bounding volume {:.4g} {}, largest extent {:.4g} m\n", body.mass,
               body.bounding_volume, Dim == 2 ? "m^2" : "m^3", body.extent);
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const Source<Dim>& source = scene.sources[i];
    print_result("  source[{}]: {} bodies at {:g} a second from {:g} s on; its spout reaches {:.3g} a second\n", i,
                 source.count, source.rate, source.start, reachable_rate(source, scene.world));
  }
}

/// Prints the warnings of all these engines, those that all have once; whether there is any.
template <int Dim>
bool print_warnings(const Scene<Dim>& scene, const std::vector<std::string>& engines) {
  std::vector<std::string> printed;
  for (const std::string& backend : engines)
    for (const std::string& warning : scene_warnings(scene, backend))
      if (std::ranges::find(printed, warning) == printed.end()) printed.push_back(warning);
  for (const std::string& warning : printed) print_result("  warning: {}\n", printable(warning));
  return !printed.empty();
}

/// Builds what a run would build on each of these engines, where the scene lies in the engine's window or `force` is
/// given: `check` refuses what every one of them refuses. Whether there was a warning.
template <int Dim>
bool try_engines(const Scene<Dim>& scene, const std::string& file, const std::vector<std::string>& engines,
                 bool force) {
  std::string refusals;
  std::size_t refused = 0;
  bool warned = false;
  for (const std::string& backend : engines) {
    try {
      const std::vector<SceneError> outside = check_window(scene, backend, file, force);
      print_scene_warnings(outside, {});
      warned = warned || !outside.empty();
      make_simulation(scene, backend);
    } catch (const std::invalid_argument& refusal) {
      refusals += fmt::format("{}{}: {}: {}", refused == 0 ? "" : "\n", file, backend, refusal.what());
      ++refused;
    }
  }
  if (refused > 0 && refused == engines.size()) throw std::invalid_argument(refusals);
  if (refused > 0) print_result("{}\n", refusals);
  return warned || refused > 0;
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

template <int Dim>
bool check_on_engines(const Scene<Dim>& scene, const std::string& file, const SceneChoice& choice) {
  const std::vector<std::string> engines =
      choice.backend.empty() ? backends(Dim) : std::vector<std::string>{choice.backend};
  bool warned = try_engines(scene, file, engines, choice.force);
#ifdef TALUS_LCM
  try_messages(scene, file);
#endif
  print_result("{}: OK\n", printable(file));
  print_report(scene);
  warned = print_warnings(scene, engines) || warned;
  return warned;
}

int check_scene(const SceneChoice& choice, bool strict) {
  const std::filesystem::path file = find_scene(choice.scene);
  const AnyScene scene = read_scene(file, overrides_of(choice));
  const bool warned = std::visit(
      [&](const auto& of_dimension) { return check_on_engines(of_dimension, file.string(), choice); }, scene);
  return strict && warned ? exit_codes::failed : exit_codes::success;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("check", "Read a scene without running it: all its errors, or what it will do");
  auto choice = std::make_shared<SceneChoice>();
  auto strict = std::make_shared<bool>(false);
  add_scene_options(*command, *choice);
  command->add_flag("--strict", *strict, "Exit with 1 where there is a warning");
  command->callback([=, &exit_code] { exit_code = check_scene(*choice, *strict); });
}

}  // namespace talus
