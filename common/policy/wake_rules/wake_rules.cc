#include "common/policy/wake_rules/wake_rules.h"

#include <cassert>

namespace talus {

template <int Dim>
WakeRules<Dim>::WakeRules(const RuleSetup<Dim>& setup)
    : impacts_ahead_(setup),
      impacts_(setup),
      support_loss_(setup),
      avalanches_(setup),
      checks_(setup),
      sleepers_(setup.params.avalanche_width * setup.typical.extent) {}

template <int Dim>
void WakeRules<Dim>::update(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, RuleOutput<Dim>& out) {
  assert(sleepers_.matches(in.states()));
  impacts_ahead_.update(in, out);
  impacts_.update(in, rest, out);
  support_loss_.update(in, out);
  avalanches_.update(in, sleepers_, out);
  checks_.update(in, rest, sleepers_, out);
  for (VelocityChange<Dim>& change : out.velocities) {
    change.velocity = limited(change.velocity, fastest_speed<Dim>(in.world.dt(), in.world.units()));
    change.spin = limited(change.spin, fastest_spin(in.world.dt()));
  }
}

template <int Dim>
void WakeRules<Dim>::note_falling_asleep(const RuleInput<Dim>& in, std::span<const BodyIndex> bodies) {
  support_loss_.note_falling_asleep(in, bodies);
}

/// A body that sleeps by the user's request was not put there by a rule: it makes no heap slide and waits for no check.
template <int Dim>
void WakeRules<Dim>::note(const World<Dim>& world, std::span<const SleepEvent> events) {
  for (const SleepEvent& event : events) {
    if (event.woke) {
      sleepers_.take_out(event.body);
      support_loss_.note_awake(event.body);
      continue;
    }
    const Vec<Dim>& position = world.states().pose[event.body].position;
    const bool by_rule = event.cause != SleepCause::user;
    sleepers_.put_in(event.body, position, by_rule ? checks_.note_asleep(world, event.body) : Standing::settled);
    if (by_rule) avalanches_.note_asleep(position);
  }
}

template <int Dim>
void WakeRules<Dim>::forget(BodyIndex body) {
  impacts_.forget(body);
  support_loss_.forget(body);
  checks_.forget(body);
}

template class WakeRules<2>;
template class WakeRules<3>;

}  // namespace talus
