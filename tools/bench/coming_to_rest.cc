#include "tools/bench/coming_to_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/scene/typical_body.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "tools/run/backends.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

constexpr double never = std::numeric_limits<double>::quiet_NaN();

/// Places of the awake bodies, step by step; sleepers stay where they are.
template <int Dim>
class Trail {
 public:
  void add(const World<Dim>& world) {
    std::vector<Place>& places = steps_.emplace_back();
    for (const BodyIndex body : world.awake()) places.emplace_back(body, world.states().pose[body].position);
  }

  /// Number of steps until no body is farther from where it ends.
  std::size_t steps_until_within(double distance, const BodyStates<Dim>& end) const {
    const auto strays = [&](const Place& place) {
      return (end.pose[place.first].position - place.second).norm() > distance;
    };
    std::size_t step = steps_.size();
    while (step > 0 && std::none_of(steps_[step - 1].begin(), steps_[step - 1].end(), strays)) --step;
    return step;
  }

 private:
  using Place = std::pair<BodyIndex, Vec<Dim>>;
  std::vector<std::vector<Place>> steps_;
};

}  // namespace

double ComingToRest::step_time(double from) const {
  const auto first = std::min(step_seconds.size(), static_cast<std::size_t>(std::lround(from / dt)));
  const auto last = std::min(step_seconds.size(), first + static_cast<std::size_t>(std::lround(1.0 / dt)));
  if (first == last) return never;
  return std::accumulate(step_seconds.begin() + static_cast<std::ptrdiff_t>(first),
                         step_seconds.begin() + static_cast<std::ptrdiff_t>(last), 0.0) /
         static_cast<double>(last - first);
}

template <int Dim>
ComingToRest coming_to_rest(const Scene<Dim>& scene, const std::string& backend, double calm) {
  Simulation<Dim> simulation(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
  while (!simulation.emitter().finished()) simulation.step();
  const World<Dim>& world = simulation.world();
  ComingToRest rest;
  rest.bodies = static_cast<int>(world.states().size());
  rest.dt = scene.world.dt;
  Trail<Dim> trail;
  std::size_t last_awake = 0;
  const auto steps = static_cast<std::size_t>(std::lround(calm / rest.dt));
  for (std::size_t step = 1; step <= steps; ++step) {
    ProcessorWatch watch;
    simulation.step();
    rest.step_seconds.push_back(watch.lap());
    trail.add(world);
    if (!world.awake().empty()) last_awake = step;
  }
  const std::size_t still = trail.steps_until_within(0.01 * typical_body(scene).extent, world.states());
  rest.stopped = static_cast<double>(still) * rest.dt;
  rest.asleep = last_awake < steps ? static_cast<double>(last_awake + 1) * rest.dt : never;
  return rest;
}

template ComingToRest coming_to_rest(const Scene<2>&, const std::string&, double);
template ComingToRest coming_to_rest(const Scene<3>&, const std::string&, double);

}  // namespace talus
