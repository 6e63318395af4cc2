#pragma once
// A point of the solver as talus::Contact.

#include "common/solver/contact_solver.h"
#include "common/world/body.h"

namespace talus {

/// A point of the last solve, between `a` and `b` as the point has them. `swapped`: listed under `b`. `states`: after
/// the step.
template <int Dim>
Contact<Dim> solved_contact(const ContactSolver<Dim>& solver, const ContactPoint<Dim>& point, BodyIndex a, BodyIndex b,
                            bool swapped, const BodyStates<Dim>& states);

}  // namespace talus
