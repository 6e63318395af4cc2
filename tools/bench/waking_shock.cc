#include "tools/bench/waking_shock.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "common/policy/sleep_policy.h"
#include "common/simulation/simulation.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Freezes all bodies at one step and wakes them a number of steps later.
template <int Dim>
class PausePolicy final : public SleepPolicy<Dim> {
 public:
  PausePolicy(std::int64_t from, std::int64_t to) : from_(from), to_(to) {}
  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override {
    const BodyStates<Dim>& states = frame.world.states();
    for (BodyIndex body = 0; body < states.size(); ++body) {
      const bool asleep = states.asleep[body] != 0;
      if (frame.step == from_ && !asleep) decision.freeze.push_back({.body = body, .cause = SleepCause::user});
      if (frame.step == to_ && asleep) decision.thaw.push_back({.body = body, .cause = SleepCause::user});
    }
  }

 private:
  std::int64_t from_;
  std::int64_t to_;
};

template <int Dim>
double mean_speed(const BodyStates<Dim>& states) {
  double sum = 0.0;
  for (const Vec<Dim>& velocity : states.velocity) sum += velocity.norm();
  return states.velocity.empty() ? 0.0 : sum / static_cast<double>(states.velocity.size());
}

/// Largest mean speed and mean displacement over two seconds from now.
template <int Dim>
std::pair<double, double> watch(Simulation<Dim>& simulation, double dt) {
  const std::vector<Pose<Dim>> before = simulation.world().states().pose;
  const BodyStates<Dim>& states = simulation.world().states();
  double speed = 0.0;
  for (int step = 0; step < static_cast<int>(std::lround(2.0 / dt)); ++step) {
    simulation.step();
    speed = std::max(speed, mean_speed(states));
  }
  double drift = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) drift += (states.pose[i].position - before[i].position).norm();
  return {speed, before.empty() ? 0.0 : drift / static_cast<double>(before.size())};
}

}  // namespace

template <int Dim>
WakingShock waking_shock(const Scene<Dim>& scene, const std::string& backend) {
  const std::int64_t end = scene.steps();
  const std::int64_t pause = std::lround(1.0 / scene.world.dt);
  Simulation<Dim> never(scene, make_world<Dim>(backend, scene.world), std::make_unique<NoPolicy<Dim>>());
  Simulation<Dim> paused(scene, make_world<Dim>(backend, scene.world),
                         std::make_unique<PausePolicy<Dim>>(end, end + pause));
  for (std::int64_t step = 0; step < end; ++step) never.step();
  for (std::int64_t step = 0; step < end + pause; ++step) paused.step();
  WakingShock shock;
  std::tie(shock.speed_never, shock.drift_never) = watch(never, scene.world.dt);
  std::tie(shock.speed, shock.drift) = watch(paused, scene.world.dt);
  return shock;
}

template WakingShock waking_shock(const Scene<2>&, const std::string&);
template WakingShock waking_shock(const Scene<3>&, const std::string&);

}  // namespace talus
