#pragma once
// One constraint row of the solver, packed.

#include <cstdint>

#include "sim3d/bullet/lanes.h"

namespace talus::bullet {

/// What a row reads and changes of a body: 64 bytes, in place of btSolverBody's 248. Fourth lanes are 0.
struct alignas(64) PackedBody {
  Lanes linear;    // change of velocity in this step [m/s]
  Lanes angular;   // [rad/s]
  Lanes inv_mass;  // along each axis [1/kg]; 0 where the body must not move
};

/// One direction of one contact point: 96 bytes, in place of btSolverConstraint's 168. The fourth lanes of the first
/// three hold numbers of the row; they are multiplied by a body's fourth lanes, which are 0.
struct alignas(32) PackedRow {
  Lanes normal;    // on body a, on b its opposite; fourth: target impulse at rest [N s]
  Lanes turn_a;    // normal torque of a unit impulse on a; fourth: impulse per change of velocity [kg]
  Lanes turn_b;    // fourth: coefficient of friction
  Lanes effect_a;  // change of a's angular velocity by a unit impulse
  Lanes effect_b;
  float applied;  // impulse so far [N s]
  std::int32_t a;
  std::int32_t b;
  std::int32_t contact;  // the row of the normal impulse that limits this friction row

  float rhs() const { return first(shuffled<3, 3, 3, 3>(normal)); }
  float gain() const { return first(shuffled<3, 3, 3, 3>(turn_a)); }
  float friction() const { return first(shuffled<3, 3, 3, 3>(turn_b)); }
};
static_assert(sizeof(PackedRow) == 96 && sizeof(PackedBody) == 64);

/// Applies a change of the row's impulse (the same in all lanes) to both bodies, as btSolverBody::internalApplyImpulse.
inline void apply(const PackedRow& row, PackedBody& a, PackedBody& b, Lanes change) {
  a.linear = a.linear + row.normal * a.inv_mass * change;
  a.angular = a.angular + row.effect_a * change;
  b.linear = b.linear - row.normal * b.inv_mass * change;
  b.angular = b.angular + row.effect_b * change;
}

/// Solves one row and returns the change of its impulse. Replaces the scalar functions resolveSingleConstraintRow...
/// of btSequentialImpulseConstraintSolver: the four dot products at once by transposing, each as (x + y) + z.
inline float solve(PackedRow& row, PackedBody& a, PackedBody& b, Lanes lowest, Lanes highest) {
  Lanes x = row.normal * a.linear;
  Lanes y = row.turn_a * a.angular;
  Lanes z = -row.normal * b.linear;
  Lanes w = row.turn_b * b.angular;
  transpose(x, y, z, w);
  const Lanes dots = (x + y) + z;
  const Lanes approach = (dots + shuffled<1, 0, 3, 2>(dots)) * shuffled<3, 3, 3, 3>(row.turn_a);  // of a and of b
  const Lanes applied = splat(row.applied);
  const Lanes at_rest = shuffled<3, 3, 3, 3>(row.normal) - applied * splat(0);  // no softness (cfm)
  const Lanes free = (at_rest - shuffled<0, 0, 0, 0>(approach)) - shuffled<2, 2, 2, 2>(approach);
  const Lanes sum = applied + free;
  const Lanes limited = smaller(highest, larger(lowest, sum));
  const Lanes change = select_equal(limited, sum, free, limited - applied);
  row.applied = first(limited);
  apply(row, a, b, change);
  return first(change);
}

}  // namespace talus::bullet
