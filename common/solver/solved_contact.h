#pragma once
// A point of the solver as talus::Contact.

#include "common/solver/contact_solver.h"
#include "common/world/body.h"

namespace talus {

/// Whether World::contacts() lists a contact between a body or other side `a` and `b` under `b`.
template <int Dim>
bool listed_under_second(BodyIndex a, BodyIndex b, const BodyStates<Dim>& states) {
  const auto awake = [&](BodyIndex body) { return body >= 0 && states.asleep[body] == 0; };
  return !awake(a) || (awake(b) && b < a);
}

/// A point of the last solve, between `a` and `b` as the point has them. `swapped`: listed under `b`. `states`: after
/// the step.
template <int Dim>
Contact<Dim> solved_contact(const ContactSolver<Dim>& solver, const ContactPoint<Dim>& point, BodyIndex a, BodyIndex b,
                            bool swapped, const BodyStates<Dim>& states);

}  // namespace talus
