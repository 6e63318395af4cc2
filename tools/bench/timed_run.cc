#include "tools/bench/timed_run.h"

#include <algorithm>
#include <numeric>

#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "common/simulation/stopwatch.h"
#include "tools/run/backends.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

double mean_of_last(const std::vector<double>& values, std::size_t count) {
  count = std::min(count, values.size());
  if (count == 0) return 0.0;
  return std::accumulate(values.end() - static_cast<std::ptrdiff_t>(count), values.end(), 0.0) /
         static_cast<double>(count);
}

/// Sums over the steps of a run.
struct Sums {
  std::vector<double> step_seconds;
  double pour = 0.0;       // [s] of processor time
  double poured_at = 0.0;  // [s] simulated
  double awake = 0.0;      // body-steps
  double rule = 0.0;       // [s]
};

template <int Dim>
Sums run_steps(Simulation<Dim>& simulation, std::int64_t steps) {
  Sums sums;
  sums.step_seconds.reserve(steps);
  ProcessorWatch processor;
  for (std::int64_t step = 1; step < steps; ++step) {
    simulation.step();
    const double seconds = processor.lap();
    sums.step_seconds.push_back(seconds);
    if (!simulation.emitter().finished()) {
      sums.pour += seconds;
      sums.poured_at = simulation.time();
    }
    sums.awake += static_cast<double>(simulation.world().awake().size());
    const PhaseTimes phases = simulation.frame().phases;
    sums.rule += phases.count + phases.decide;
  }
  return sums;
}

std::vector<double> by_frame(const std::vector<double>& step_seconds, std::int64_t steps_per_frame,
                             std::int64_t frames) {
  std::vector<double> seconds(frames, 0.0);
  for (std::size_t i = 0; i < step_seconds.size(); ++i) seconds[(i + 1) / steps_per_frame] += step_seconds[i];
  return seconds;
}

}  // namespace

template <int Dim>
TimedRun timed_run(const Scene<Dim>& scene, const std::string& backend) {
  Simulation<Dim> simulation(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
  simulation.step();
  Stopwatch wall;
  const Sums sums = run_steps(simulation, scene.steps());
  const double wall_seconds = wall.lap();
  const double seconds = std::accumulate(sums.step_seconds.begin(), sums.step_seconds.end(), 0.0);
  const double measured = std::max(1.0, static_cast<double>(sums.step_seconds.size()));
  const BodyStates<Dim>& states = simulation.world().states();
  TimedRun run;
  run.end_hash = state_hash(states);
  run.frame_seconds = by_frame(sums.step_seconds, scene.steps_per_frame(), scene.run.frames);
  Values& values = run.values;
  values["seconds"] = seconds;
  values["wall_seconds"] = wall_seconds;
  values["pour_seconds"] = sums.pour;
  values["after_pour_seconds"] = seconds - sums.pour;
  values["poured_at"] = sums.poured_at;
  values["last_100_ms"] = 1e3 * mean_of_last(sums.step_seconds, 100);
  values["rule_ms"] = 1e3 * sums.rule / measured;
  values["mean_awake"] = sums.awake / measured;
  values["steps"] = static_cast<double>(scene.steps());
  values["bodies"] = static_cast<double>(states.size());
  values["asleep_at_end"] = static_cast<double>(std::count(states.asleep.begin(), states.asleep.end(), 1));
  if (sums.poured_at > 0.0) values["reached_rate"] = values["bodies"] / sums.poured_at;
  return run;
}

template TimedRun timed_run(const Scene<2>&, const std::string&);
template TimedRun timed_run(const Scene<3>&, const std::string&);

}  // namespace talus
