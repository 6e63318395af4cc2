#include "common/policy/heavy_blows.h"

#include <algorithm>

#include "common/policy/impulse.h"

namespace talus {

template <int Dim>
HeavyBlows<Dim>::HeavyBlows(const AdaptiveParams& params, const TypicalBody& typical,
                            const WorldDescription<Dim>& world)
    : wake_speed_(speed_to_rise(world.gravity, params.wake_height * typical.extent)),
      many_(params.heavy_blow * typical.mass),
      dt_(world.dt),
      shapes_(world.shapes) {}

template <int Dim>
void HeavyBlows<Dim>::update(const World<Dim>& world, std::vector<BodyIndex>& hit) {
  const BodyStates<Dim>& states = world.states();
  for (const BodyIndex body : world.awake()) {
    const double mass = shape_of(states, body).mass;
    const double momentum = mass * states.velocity[static_cast<std::size_t>(body)].norm();
    if (momentum > wake_speed_ * (mass + many_)) foresee(world, body, hit);
  }
  std::sort(hit.begin(), hit.end());
  hit.erase(std::unique(hit.begin(), hit.end()), hit.end());
}

/// Ring by ring around those whom the body reaches within two steps, since what is decided now is in force for the next
/// step and who is reached in it must be awake; until all are too heavy to be given the wake speed together.
template <int Dim>
void HeavyBlows<Dim>::foresee(const World<Dim>& world, BodyIndex body, std::vector<BodyIndex>& hit) {
  const BodyStates<Dim>& states = world.states();
  const auto i = static_cast<std::size_t>(body);
  Box<Dim> swept = bounds_at(shape_of(states, body), states.pose[i]);
  swept.extend(Box<Dim>(swept).translate(2.0 * dt_ * states.velocity[i]));
  double mass = shape_of(states, body).mass;
  const double momentum = mass * states.velocity[i].norm();
  std::size_t first = hit.size();
  reached_.resize(states.asleep.size(), 0);
  ring_.clear();
  world.near(swept, ring_);
  while (!ring_.empty() && momentum > wake_speed_ * mass) {
    next_.clear();
    for (const BodyIndex other : ring_) {
      const auto o = static_cast<std::size_t>(other);
      if (states.asleep[o] == 0 || reached_[o] != 0) continue;
      reached_[o] = 1;
      hit.push_back(other);
      mass += shape_of(states, other).mass;
      world.near(bounds_at(shape_of(states, other), states.pose[o]), next_);
    }
    ring_.swap(next_);
  }
  for (; first < hit.size(); ++first) reached_[static_cast<std::size_t>(hit[first])] = 0;
}

template class HeavyBlows<2>;
template class HeavyBlows<3>;

}  // namespace talus
