#include "common/solver/solved_contact.h"

#include <algorithm>

namespace talus {

template <int Dim>
Contact<Dim> solved_contact(const ContactSolver<Dim>& solver, const ContactPoint<Dim>& point, BodyIndex a, BodyIndex b,
                            bool swapped, const BodyStates<Dim>& states) {
  const double sign = swapped ? 1.0 : -1.0;  // the result's normal points to its first body
  Contact<Dim> contact;
  contact.a = swapped ? b : a;
  contact.b = swapped ? a : b;
  const VecF<Dim>& arm = swapped ? point.arm_b : point.arm_a;
  contact.point = states.pose[contact.a].position + arm.template cast<double>();
  contact.normal = sign * point.normal.template cast<double>();
  contact.normal_impulse = point.normal_sum;
  contact.friction_impulse = sign * point.friction_sum.template cast<double>();
  contact.approach_speed = std::max(0.0F, point.approach_speed);
  contact.depth = -solver.gap_after(point);
  return contact;
}

template Contact<2> solved_contact(const ContactSolver<2>&, const ContactPoint<2>&, BodyIndex, BodyIndex, bool,
                                   const BodyStates<2>&);
template Contact<3> solved_contact(const ContactSolver<3>&, const ContactPoint<3>&, BodyIndex, BodyIndex, bool,
                                   const BodyStates<3>&);

}  // namespace talus
