#include "tools/run/run_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/measure/resting_shape.h"
#include "common/scene/accuracy.h"
#include "common/scene/happened.h"
#include "common/scene/write_scene.h"
#include "common/simulation/state_hash.h"
#include "common/text/file.h"
#include "tools/run/shape_json.h"
#include "tools/run/version.h"

namespace talus {
namespace fs = std::filesystem;

namespace {

/// Whether the folder is this run's alone: it was empty or not there, and this process made the first file in it. Of
/// runs that start at the same time one wins. Throws std::filesystem::filesystem_error where no file can be made.
bool claim(const fs::path& folder) {
  fs::create_directories(folder);
  if (!fs::is_empty(folder)) return false;
  const fs::path first = folder / scene_file_name;
  std::FILE* file = std::fopen(first.c_str(), "wx");
  if (file != nullptr) return std::fclose(file) == 0;
  if (errno == EEXIST) return false;
  throw fs::filesystem_error("cannot make a file", first, std::error_code(errno, std::generic_category()));
}

/// The first folder of runs/NAME, runs/NAME-2, ... that is this run's alone.
fs::path claim_numbered(const std::string& name) {
  fs::path folder = fs::path("runs") / name;
  for (int number = 2; fs::exists(folder) || !claim(folder); ++number)
    folder = fs::path("runs") / fmt::format("{}-{}", name, number);
  return folder;
}

}  // namespace

fs::path make_run_folder(const fs::path& wanted, const std::string& name) {
  try {
    if (wanted.empty()) return claim_numbered(name);
    if ((!fs::exists(wanted) || fs::is_directory(wanted)) && claim(wanted)) return wanted;
  } catch (const fs::filesystem_error& error) {
    throw std::invalid_argument(fmt::format("{} = {}: {}", wanted.empty() ? "run folder" : "--out",
                                            error.path1().string(), error.code().message()));
  }
  throw std::invalid_argument(
      fmt::format("--out = {}: must be a new or empty folder; nothing is overwritten", wanted.string()));
}

namespace {

using Json = nlohmann::ordered_json;

Json phases_json(const PhaseTimes& sum, double steps) {
  Json phases;
  for (const Phase& phase : all_phases)
    phases[std::string(phase.name)] = steps > 0.0 ? 1e3 * sum.*phase.time / steps : 0.0;
  return phases;
}

template <int Dim>
Json settings_json(const Scene<Dim>& scene) {
  const SolverParams& solver = scene.world.solver;
  return {{"dimension", Dim},
          {"gravity", scene.world.gravity},
          {"dt_s", scene.world.dt},
          {"solver", solver.kind},
          {"sub_steps", solver.sub_steps},
          {"velocity_iterations", solver.velocity_iterations},
          {"position_iterations", solver.position_iterations},
          {"friction_directions", solver.friction_directions},
          {"restitution_threshold", solver.restitution_threshold},
          {"frames", scene.run.frames},
          {"frame_rate", scene.run.frame_rate}};
}

/// Shape of what lies still enough to be part of the pile; null where nothing does.
template <int Dim>
Json shape_of_rest_json(const Scene<Dim>& scene, const Simulation<Dim>& simulation) {
  const double extent = simulation.piles().typical_body().extent;
  const auto bodies = resting_bodies(scene, simulation.world().states());
  if (bodies.empty()) return nullptr;
  const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, scene.world.ground.height, extent);
  Json json = {{"bodies_at_rest", bodies.size()}};
  json.update(shape_json<Dim>(bodies, shape_statistics<Dim>(bodies, grid), grid,
                              world_at(scene, simulation.done_events(), simulation.time()), extent));
  return json;
}

Json warnings_json(std::span<const Warning> warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) {
    list.push_back({{"kind", to_string(warning.kind)},
                    {"step", warning.step},
                    {"body", warning.body},
                    {"bodies", warning.bodies},
                    {"value", warning.value},
                    {"text", advice(warning)}});
  }
  return list;
}

Json outside_json(std::span<const SceneError> outside) {
  Json list = Json::array();
  for (const SceneError& each : outside)
    list.push_back({{"field", each.field}, {"value", each.value}, {"rule", each.rule}});
  return list;
}

template <int Dim>
Json piles_json(const PileSet<Dim>& piles) {
  Json list = Json::array();
  for (const Pile<Dim>& pile : piles.piles()) {
    list.push_back({{"centre", std::vector<double>(pile.centre.begin(), pile.centre.end())},
                    {"structure_size", pile.structure_size},
                    {"layers", pile.layers.size()},
                    {"occupation_ratio", pile.occupation_ratio()}});
  }
  return list;
}

template <int Dim>
Json events_json(const Scene<Dim>& scene, std::span<const DoneEvent> events) {
  Json list = Json::array();
  for (const DoneEvent& event : events)
    list.push_back({{"number", event.number},
                    {"time_s", event.time},
                    {"do", to_string(scene.events[event.number].action)},
                    {"text", event_text(scene, event)}});
  return list;
}

/// Null where neither the probe nor the policy has a result.
Json drift_estimate_json(const std::optional<DriftProbe>& probe, const std::optional<ToldDrift>& told) {
  if (!told) return nullptr;
  return {{"drift_D", told->drift},
          {"least_D", probe ? Json(probe->least) : Json()},
          {"most_D", probe ? Json(probe->most) : Json()},
          {"probed_s", probe ? probe->seconds : 0.0},
          {"checked_share", told->checked_share}};
}

/// Null where it was not measured; without numbers where it could not be.
Json measured_json(const std::optional<MeasuredDrift>& drift) {
  if (!drift) return nullptr;
  const bool known = drift->missing.empty();
  const auto where_known = [&](double in_extents) { return known ? Json(in_extents) : Json(); };
  return {{"missing", drift->missing},
          {"bodies", drift->bodies},
          {"simulated_s", drift->seconds},
          {"drift_mean_D", where_known(drift->mean)},
          {"drift_p95_D", where_known(drift->p95)},
          {"drift_max_D", where_known(drift->max)}};
}

template <int Dim>
Json statistics_json(const RunStatistics<Dim>& statistics) {
  return {{"steps", statistics.steps()},
          {"ms_per_step", statistics.mean_step_ms()},
          {"ms_per_step_last_100", statistics.last_step_ms()},
          {"ms_per_phase", phases_json(statistics.sum(), static_cast<double>(statistics.steps()))},
          {"mean_awake", statistics.mean_awake()},
          {"slept_events", statistics.slept()},
          {"woken_events", statistics.woken()},
          {"work_skipped", statistics.work_skipped()}};
}

}  // namespace

template <int Dim>
void write_summary(const fs::path& file, const SummaryInput& input, const Scene<Dim>& scene,
                   const Simulation<Dim>& simulation, const RunStatistics<Dim>& statistics,
                   const InstrumentWatch<Dim>& instruments) {
  const World<Dim>& world = simulation.world();
  const auto bodies = world.states().shape.size();
  Json summary = {
      {"talus", version_text()},
      {"build", build_text()},
      {"scene", input.scene_name},
      {"title", scene.title},
      {"backend", input.backend},
      {"policy", scene.policy.kind},
      {"seed", scene.seed},
      {"settings", settings_json(scene)},
      {"reason", input.reason},
      {"bodies", bodies},
      {"bodies_planned", simulation.emitter().total()},
      {"bodies_appeared", simulation.emitter().emitted()},
      {"bodies_lost", bodies_lost(world.states(), scene.world.ground, scene.world.units)},
      {"at_rest", simulation.at_rest()},
      {"events", events_json(scene, simulation.done_events())},
      {"asleep_at_end", bodies_asleep(world)},
      {"outside_window", outside_json(input.outside_window)},
      {"scene_warnings", input.scene_warnings},
      {"warnings", warnings_json(input.warnings)},
      {"overlap", {{"deepest_D", simulation.frame().overlap.deepest}, {"share", simulation.frame().overlap.share}}},
      {"emit_waits", input.emit_waits},
      {"picture_pixels_per_m", input.pixels_per_metre},
      {"wall_s", input.wall_seconds}};
  summary.update(statistics_json(statistics));
  const std::optional<double> error = calibrated_error(scene);
  summary["accuracy"] = {{"level", scene.accuracy}, {"error", error ? Json(*error) : Json()}};
  summary["shape"] = shape_of_rest_json(scene, simulation);
  summary["estimate"] = drift_estimate_json(input.probe, told_drift(simulation.frame()));
  summary["measured"] = measured_json(input.measured);
  summary["piles"] = piles_json(simulation.piles());
  instruments.add_to(summary);
  summary["end_hash"] = fmt::format("{:016x}", state_hash(world.states()));
  write_file(file, summary.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

template void write_summary(const fs::path&, const SummaryInput&, const Scene<2>&, const Simulation<2>&,
                            const RunStatistics<2>&, const InstrumentWatch<2>&);
template void write_summary(const fs::path&, const SummaryInput&, const Scene<3>&, const Simulation<3>&,
                            const RunStatistics<3>&, const InstrumentWatch<3>&);

}  // namespace talus
