#pragma once
// What an impulse at a point does to a free rigid body.

#include <cmath>

#include "common/shape/shape.h"

namespace talus {

/// Speed with which a body rises by `height` [m] against `gravity` [m/s^2].
inline double speed_to_rise(double gravity, double height) { return std::sqrt(2.0 * gravity * height); }

/// Speed that a unit impulse along the unit vector `along` at `place` [m] gives the body at that place, in the same
/// direction [1/kg].
template <int Dim>
double yielding(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& place, const Vec<Dim>& along);

/// Adds an impulse [N s] at `place` [m] to a body's velocity [m/s] and spin [rad/s].
template <int Dim>
void push(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& place, const Vec<Dim>& impulse,
          Vec<Dim>& velocity, Spin<Dim>& spin);

}  // namespace talus
