#include "common/policy/wake_rules/impacts.h"

#include <algorithm>
#include <tuple>

#include "common/shape/rigid_impulse.h"

namespace talus {
namespace {

template <typename ContactImpulse>
bool pair_before(const ContactImpulse& l, const ContactImpulse& r) {
  return std::tie(l.awake, l.sleeper) < std::tie(r.awake, r.sleeper);
}

/// Part of an impact that counts, by how steeply the impulse on the awake body rises, from -1 to 1: 1/3 for an impact
/// from straight above, since the sleeping body's supports take up the rest; 1 from the side; 5/3 from below, where
/// nothing resists. The slope 2/3 separated the bodies that moved from the others best (lab/notes/impact_rule.md).
double direction_factor(double rise) { return 1.0 - 2.0 / 3.0 * rise; }

/// Adds an impulse [N s] at a point [m] to the velocity that a body gets.
template <int Dim>
void change_velocity(const RuleInput<Dim>& in, BodyIndex body, const Vec<Dim>& point, const Vec<Dim>& impulse,
                     RuleOutput<Dim>& out) {
  VelocityChange<Dim>& change = out.velocity_of(body, in.states());
  apply_impulse<Dim>(in.shape_of(body), in.world.pose_near(body, point), point, impulse, change.velocity, change.spin);
}

}  // namespace

template <int Dim>
Impacts<Dim>::Impacts(const RuleSetup<Dim>& setup) : wake_height_(setup.params.wake_height * setup.typical.extent) {}

template <int Dim>
void Impacts<Dim>::update(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, RuleOutput<Dim>& out) {
  collect(in);
  const double wake_speed = speed_to_rise(in.world.gravity_size(), wake_height_);
  for (const ContactImpulse& contact : impulses_) {
    const Impact impact = evaluate(in, rest, contact);
    if (!(impact.speed > wake_speed)) continue;
    out.wakes.try_emplace(contact.sleeper, Wake{.cause = SleepCause::momentum});
    change_velocity<Dim>(in, contact.awake, contact.point, (impact.share - 1.0) * impact.impulse, out);
    change_velocity<Dim>(in, contact.sleeper, contact.point, -impact.share * impact.impulse, out);
  }
}

template <int Dim>
void Impacts<Dim>::forget(BodyIndex body) {
  std::erase_if(impulses_,
                [body](const ContactImpulse& contact) { return contact.awake == body || contact.sleeper == body; });
}

template <int Dim>
void Impacts<Dim>::collect(const RuleInput<Dim>& in) {
  last_impulses_.swap(impulses_);
  impulses_.clear();
  fastest_approach_ = 0.0;
  for (const Contact<Dim>& contact : in.contacts) {
    fastest_approach_ = std::max(fastest_approach_, contact.approach_speed);
    if (contact.b < 0 || !in.asleep(contact.b)) continue;
    if (impulses_.empty() || impulses_.back().awake != contact.a || impulses_.back().sleeper != contact.b)
      impulses_.push_back({.awake = contact.a, .sleeper = contact.b});
    ContactImpulse& sum = impulses_.back();
    sum.impulse += contact.normal_impulse * contact.normal + contact.friction_impulse;
    sum.normal_impulse += contact.normal_impulse;
    if (sum.normal_impulse > 0.0)
      sum.point += contact.normal_impulse / sum.normal_impulse * (contact.point - sum.point);
    sum.approach_speed = std::max(sum.approach_speed, contact.approach_speed);
  }
}

/// An inelastic impact: against a free body the impulse is the share K_a / (K_a + K_b) of that against an immovable
/// one. Engines push harder than the motion explains where bodies overlap deeply, so the struck point gets no more than
/// the fastest approach speed of the step.
template <int Dim>
typename Impacts<Dim>::Impact Impacts<Dim>::evaluate(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest,
                                                     const ContactImpulse& contact) const {
  const double size = contact.impulse.norm();
  if (!(size > 0.0)) return {};
  const Vec<Dim> direction = contact.impulse / size;
  const auto inverse_mass = [&](BodyIndex body) {
    return inverse_effective_mass<Dim>(in.shape_of(body), in.world.pose_near(body, contact.point), contact.point,
                                       direction);
  };
  const double awake = inverse_mass(contact.awake);
  const double sleeper = inverse_mass(contact.sleeper);
  Impact impact;
  impact.share = awake / (awake + sleeper);
  const double most = fastest_approach_ / (impact.share * sleeper);
  impact.impulse = std::clamp(increase(rest, contact, direction, awake), 0.0, std::min(size, most)) * direction;
  impact.speed = direction_factor(in.rise(direction)) * impact.share * impact.impulse.norm() * sleeper;
  return impact;
}

/// The part of the impulse that exceeds the load of the step before [N s]. The load is unknown where one of the two has
/// just woken or fallen asleep; there the impulse that stops their approach is an upper bound.
template <int Dim>
double Impacts<Dim>::increase(const RestCriterion<Dim>& rest, const ContactImpulse& contact, const Vec<Dim>& direction,
                              double awake_inverse_mass) const {
  if (!rest.was_awake(contact.awake) || rest.was_awake(contact.sleeper))
    return contact.approach_speed / awake_inverse_mass;
  const auto last =
      std::lower_bound(last_impulses_.begin(), last_impulses_.end(), contact, pair_before<ContactImpulse>);
  if (last != last_impulses_.end() && !pair_before(contact, *last))
    return (contact.impulse - last->impulse).dot(direction);
  return contact.impulse.norm();
}

template class Impacts<2>;
template class Impacts<3>;

}  // namespace talus
