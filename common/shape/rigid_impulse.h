#pragma once
// The effect of an impulse at a point of a free rigid body.

#include <cmath>

#include "common/shape/shape.h"

namespace talus {

/// Speed with which a body rises by `height` [m] against `gravity` [m/s^2].
inline double speed_to_rise(double gravity, double height) { return std::sqrt(2.0 * gravity * height); }

/// Moment of a force, or of a momentum, at a lever arm.
inline Spin<2> moment(const Vec2& arm, const Vec2& force) { return Spin<2>(arm[0] * force[1] - arm[1] * force[0]); }
inline Spin<3> moment(const Vec3& arm, const Vec3& force) { return arm.cross(force); }

/// K = 1/m + (r x n) . I^-1 (r x n) [1/kg]: the speed that a unit impulse along the unit vector `direction` at `point`
/// [m] gives that point in the same direction.
template <int Dim>
double inverse_effective_mass(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& point,
                              const Vec<Dim>& direction);

/// Adds the effect of an impulse [N s] at `point` [m] to a body's velocity [m/s] and spin [rad/s].
template <int Dim>
void apply_impulse(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& point, const Vec<Dim>& impulse,
                   Vec<Dim>& velocity, Spin<Dim>& spin);

}  // namespace talus
