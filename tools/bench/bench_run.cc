#include "tools/bench/bench_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/measure/compare.h"
#include "common/measure/ensemble.h"
#include "common/measure/rebuild.h"
#include "common/measure/resting_shape.h"
#include "common/scene/happened.h"
#include "common/scene/typical_body.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/state_hash.h"
#include "common/world/stopwatch.h"
#include "tools/run/backends.h"
#include "tools/run/measured_drift.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

using Json = nlohmann::json;

template <int Dim>
Simulation<Dim> bench_simulation(const Scene<Dim>& scene, const std::string& backend) {
  return Simulation<Dim>(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
}

/// Steps to the end; processor time by frame of output. The first step is left out: in it the engine allocates.
template <int Dim>
std::vector<double> time_steps(Simulation<Dim>& simulation, const Scene<Dim>& scene, BenchNumbers& numbers) {
  std::vector<double> frames(scene.run.frames, 0.0);
  simulation.step();
  Stopwatch wall;
  ProcessorWatch processor;
  double awake = 0.0;  // body-steps
  for (std::int64_t step = 1; step < scene.steps(); ++step) {
    simulation.step();
    frames[step / scene.steps_per_frame()] += processor.lap();
    awake += static_cast<double>(simulation.world().awake().size());
  }
  numbers.wall_seconds = wall.lap();
  numbers.seconds = 0.0;
  for (const double frame : frames) numbers.seconds += frame;
  numbers.steps = static_cast<double>(scene.steps());
  numbers.mean_awake = awake / static_cast<double>(std::max<std::int64_t>(1, scene.steps() - 1));
  return frames;
}

/// Mean distance over D that bodies move once all are woken. Nothing where something still drives them.
template <int Dim>
double drift_after(const Simulation<Dim>& simulation, const Scene<Dim>& scene, const std::string& backend) {
  constexpr double in_flight = 1.0;  // [m/s]; faster bodies would count as displaced when they land
  const auto world = world_at<Dim>(scene, simulation.done_events(), simulation.time());
  if (still_driven(scene, simulation.done_events(), simulation.time()) || world.gravity <= 0.0)
    return BenchNumbers::none;
  BodyStates<Dim> last = simulation.world().states();
  for (BodyIndex i = 0; i < last.size(); ++i)
    if (last.velocity[i].norm() > in_flight) last.removed[i] = 1;
  const WakeTest test = wake_all<Dim>(world, backend, last, {.duration = wake_time(world.gravity)});
  return test.bodies > 0 ? test.mean / typical_body(scene).extent : BenchNumbers::none;
}

template <int Dim>
Trajectory<Dim> recorded(const Scene<Dim>& scene, const std::string& backend) {
  Simulation<Dim> simulation = bench_simulation(scene, backend);
  TrajectoryRecorder<Dim> recorder(scene.world.dt, scene.steps_per_frame(), scene.world.periodic());
  simulation.add_observer(recorder);
  for (std::int64_t step = 0; step < scene.steps(); ++step) simulation.step();
  return recorder.trajectory();
}

/// The paper's error of each frame. `scene` is the case's.
template <int Dim>
std::vector<MotionError> errors_of(const BenchCase& bench_case, Scene<Dim> scene) {
  BenchCase full = bench_case;
  full.policy = "full";
  full.settings = settings_of_world(full.settings);
  const Trajectory<Dim> of_full = recorded(std::get<Scene<Dim>>(load(full)), full.backend);
  if (bench_case.policy == "full" && !scene.sources.empty()) scene.sources.front().position[0] += 1e-6;
  return motion_errors<Dim>(of_full, recorded(scene, bench_case.backend), extents_of<Dim>(scene.world.shapes),
                            scene.world.gravity);
}

template <int Dim>
BenchRow measured_row(const BenchCase& bench_case, const Scene<Dim>& scene, const BenchExtras& extras) {
  BenchRow row{bench_case, {}, {}, {}, {}};
  Simulation<Dim> simulation = bench_simulation(scene, bench_case.backend);
  const std::vector<double> frames = time_steps(simulation, scene, row.numbers);
  const BodyStates<Dim>& states = simulation.world().states();
  row.end_hash = fmt::format("{:016x}", state_hash(states));
  row.numbers.bodies = static_cast<double>(std::count(states.removed.begin(), states.removed.end(), 0));
  row.numbers.asleep_at_end = static_cast<double>(std::count(states.asleep.begin(), states.asleep.end(), 1));
  if (const auto shape = resting_shape(scene, states, typical_body(scene).extent)) {
    row.numbers.centre_height = shape->centre_height;
    row.numbers.r50 = shape->r50;
  }
  if (extras.drift) row.numbers.drift = drift_after(simulation, scene, bench_case.backend);
  if (!extras.motion_error || bench_case.policy == reference_policy) return row;
  const std::vector<MotionError> errors = errors_of(bench_case, scene);
  row.numbers.motion_error = average(errors).relative;
  for (std::size_t i = 0; extras.frames && i < std::min(errors.size(), frames.size()); ++i)
    row.frames.push_back({static_cast<double>(i) / scene.run.frame_rate, frames[i], errors[i].relative});
  return row;
}

/// JSON has no NaN.
double number_or_none(const Json& json) { return json.is_number() ? json.get<double>() : BenchNumbers::none; }

}  // namespace

std::vector<std::string> settings_of_world(const std::vector<std::string>& settings) {
  std::vector<std::string> kept = settings;
  std::erase_if(kept, [](const std::string& setting) { return setting.starts_with("policy."); });
  return kept;
}

AnyScene load(const BenchCase& bench_case) {
  const bool reference = bench_case.policy == reference_policy;
  std::vector<Override> overrides;
  for (const std::string& setting : bench_case.settings) overrides.push_back({setting});
  overrides.push_back({"policy.kind=" + (reference ? std::string("full") : bench_case.policy)});
  overrides.push_back({fmt::format("seed={}", bench_case.seed)});
  AnyScene scene = read_scene(bench_case.scene, overrides);
  std::visit(
      [&](auto& each) {
        if (reference) each = reference_scene(std::move(each));
        if (each.sources.empty() && !each.bodies.empty())
          each.bodies.front().def.pose.position[0] += 1e-6 * (bench_case.seed - 1);
      },
      scene);
  return scene;
}

BenchRow bench_run(const BenchCase& bench_case, const BenchExtras& extras) {
  return std::visit([&](const auto& scene) { return measured_row(bench_case, scene, extras); }, load(bench_case));
}

std::string line_of(const BenchRow& row) {
  Json json = {{"end_hash", row.end_hash}, {"frames", Json::array()}};
  for (const BenchColumn& column : bench_columns) json["numbers"].push_back(row.numbers.*column.number);
  for (const BenchFrame& frame : row.frames) json["frames"].push_back({frame.time, frame.seconds, frame.motion_error});
  return json.dump();
}

BenchRow row_of(const BenchCase& bench_case, const std::string& line) {
  const Json json = Json::parse(line);
  BenchRow row{bench_case, {}, json.at("end_hash"), {}, {}};
  for (std::size_t i = 0; i < bench_columns.size(); ++i)
    row.numbers.*bench_columns[i].number = number_or_none(json.at("numbers").at(i));
  for (const Json& frame : json.at("frames"))
    row.frames.push_back({frame.at(0), frame.at(1), number_or_none(frame.at(2))});
  return row;
}

}  // namespace talus
