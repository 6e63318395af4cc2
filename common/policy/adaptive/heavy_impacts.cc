#include "common/policy/adaptive/heavy_impacts.h"

#include "common/policy/adaptive/impacts.h"

namespace talus {

template <int Dim>
HeavyImpacts<Dim>::HeavyImpacts(const RuleSetup<Dim>& setup)
    : wake_speed_(wake_speed(setup)),
      heavy_mass_(setup.params.heavy_impact * setup.typical.mass),
      dt_(setup.world.dt) {}

template <int Dim>
void HeavyImpacts<Dim>::update(const RuleInput<Dim>& in, RuleOutput<Dim>& out) {
  for (const BodyIndex body : in.world.awake()) {
    const double mass = in.shape_of(body).mass;
    const double momentum = mass * in.states().velocity[body].norm();
    if (momentum > wake_speed_ * (mass + heavy_mass_)) wake_ahead(in, body, out);
  }
}

/// Wakes ring by ring around the bodies in the path, until the woken bodies are together too heavy to reach the wake
/// speed. The path is two steps long: a decision takes effect in the next step, and bodies reached during that step
/// must be awake when it begins.
template <int Dim>
void HeavyImpacts<Dim>::wake_ahead(const RuleInput<Dim>& in, BodyIndex body, RuleOutput<Dim>& out) {
  const Vec<Dim>& velocity = in.states().velocity[body];
  Box<Dim> path = in.world.bounds_of(body);
  path.extend(Box<Dim>(path).translate(2.0 * dt_ * velocity));
  double mass = in.shape_of(body).mass;
  const double momentum = mass * velocity.norm();
  reached_.resize(in.states().asleep.size(), 0);
  woken_.clear();
  ring_.clear();
  in.world.query_box(path, ring_);
  while (!ring_.empty() && momentum > wake_speed_ * mass) {
    next_ring_.clear();
    for (const BodyIndex other : ring_) {
      if (!in.asleep(other) || reached_[other] != 0) continue;
      reached_[other] = 1;
      woken_.push_back(other);
      mass += in.shape_of(other).mass;
      in.world.query_box(in.world.bounds_of(other), next_ring_);
    }
    ring_.swap(next_ring_);
  }
  for (const BodyIndex other : woken_) {
    reached_[other] = 0;
    out.wakes.add(other, {.cause = SleepCause::momentum, .before_impact = true});
  }
}

template class HeavyImpacts<2>;
template class HeavyImpacts<3>;

}  // namespace talus
