#include "tools/bench/timed_run.h"

#include <algorithm>
#include <ctime>
#include <numeric>

#include "common/policy/sleep_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "common/simulation/stopwatch.h"
#include "tools/run/backends.h"

namespace talus {

namespace {

/// Processor time of this thread between laps [s].
class ProcessorWatch {
 public:
  double lap() {
    const double now = read();
    const double passed = now - last_;
    last_ = now;
    return passed;
  }

 private:
  static double read() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double last_ = read();
};

double mean_of_last(const std::vector<double>& values, std::size_t count) {
  count = std::min(count, values.size());
  if (count == 0) return 0.0;
  return std::accumulate(values.end() - static_cast<std::ptrdiff_t>(count), values.end(), 0.0) /
         static_cast<double>(count);
}

}  // namespace

template <int Dim>
TimedRun timed_run(const Scene<Dim>& scene, const std::string& backend) {
  Simulation<Dim> simulation(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
  simulation.step();
  const auto steps = static_cast<std::size_t>(scene.steps());
  std::vector<double> step_seconds;
  step_seconds.reserve(steps);
  TimedRun run;
  run.frame_seconds.assign(static_cast<std::size_t>(scene.run.frames), 0.0);
  double pour = 0.0;
  double awake = 0.0;
  double rule = 0.0;
  Stopwatch wall;
  ProcessorWatch processor;
  for (std::size_t step = 1; step < steps; ++step) {
    simulation.step();
    const double seconds = processor.lap();
    step_seconds.push_back(seconds);
    run.frame_seconds[step / static_cast<std::size_t>(scene.steps_per_frame())] += seconds;
    if (!simulation.emitter().finished()) pour += seconds;
    awake += static_cast<double>(simulation.world().awake().size());
    const PhaseTimes phases = simulation.frame().phases;
    rule += phases.count + phases.decide;
  }
  const auto measured = static_cast<double>(step_seconds.size());
  const double seconds = std::accumulate(step_seconds.begin(), step_seconds.end(), 0.0);
  const World<Dim>& world = simulation.world();
  run.end_hash = state_hash(world.states());
  run.values = {{"seconds", seconds},
                {"wall_seconds", wall.lap()},
                {"pour_seconds", pour},
                {"calm_seconds", seconds - pour},
                {"last_100_ms", 1e3 * mean_of_last(step_seconds, 100)},
                {"rule_ms", measured > 0.0 ? 1e3 * rule / measured : 0.0},
                {"mean_awake", measured > 0.0 ? awake / measured : 0.0},
                {"steps", static_cast<double>(steps)},
                {"bodies", static_cast<double>(world.states().size())},
                {"asleep_at_end",
                 static_cast<double>(std::count(world.states().asleep.begin(), world.states().asleep.end(), 1))}};
  return run;
}

template TimedRun timed_run(const Scene<2>&, const std::string&);
template TimedRun timed_run(const Scene<3>&, const std::string&);

}  // namespace talus
