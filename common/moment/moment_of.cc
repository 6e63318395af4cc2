
#include "common/math/in_space.h"
#include "common/moment/moment.h"
#include "common/policy/sleep_policy.h"
#include "common/world/energy.h"

namespace talus {
namespace {

template <int Dim>
MomentBodies bodies_of(const BodyStates<Dim>& states) {
  MomentBodies bodies(Dim);
  const std::size_t count = states.shape.size();
  bodies.shape = states.shape;
  bodies.asleep = states.asleep;
  bodies.removed = states.removed;
  bodies.unknown.assign(count, 0);
  bodies.cause.assign(count, -1);
  bodies.pose.resize(count);
  for (std::size_t i = 0; i < count; ++i) bodies.pose.set<Dim>(i, states.pose[i]);
  return bodies;
}

}  // namespace

template <int Dim>
std::vector<Pile<3>> piles_in_space(const Frame<Dim>& frame) {
  std::vector<Pile<3>> piles;
  for (const Pile<Dim>& pile : frame.piles.piles()) {
    Pile<3>& made = piles.emplace_back(in_space(pile));
    if (frame.policy != nullptr) set_thresholds<Dim>(*frame.policy, made.layers);
  }
  return piles;
}

template <int Dim>
Moment moment_of(const Frame<Dim>& frame) {
  Moment moment(Dim);
  moment.step = frame.step;
  moment.time = frame.time;
  moment.bodies = bodies_of(frame.world.states());
  moment.events.assign(frame.events.begin(), frame.events.end());
  for (const SleepEvent& event : frame.events) moment.bodies.cause[event.body] = static_cast<std::int8_t>(event.cause);
  moment.piles = piles_in_space(frame);
  moment.warnings.assign(frame.warnings.begin(), frame.warnings.end());
  moment.kinetic_energy = kinetic_energy(frame.world);
  if (const std::optional<ToldDrift> drift = told_drift(frame)) moment.drift = drift->drift;
  moment.done.assign(frame.done_events.begin(), frame.done_events.end());
  const std::span<const Obstacle<Dim>> obstacles = frame.world.obstacles();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (!obstacles[k].moves) continue;
    moment.obstacle_pose.resize(moment.moved_obstacle.size() + 1);
    moment.obstacle_pose.set<Dim>(moment.moved_obstacle.size(), obstacles[k].pose);
    moment.moved_obstacle.push_back(static_cast<int>(k));
  }
  return moment;
}

template std::vector<Pile<3>> piles_in_space(const Frame<2>&);
template std::vector<Pile<3>> piles_in_space(const Frame<3>&);
template Moment moment_of(const Frame<2>&);
template Moment moment_of(const Frame<3>&);

}  // namespace talus
