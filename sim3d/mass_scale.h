#pragma once
// The unit of mass in a Bullet world.

#include <span>

#include "common/shape/shape.h"

namespace talus::bullet {

/// Masses that Bullet holds as they are [kg]. Its solver leaves out each contact between bodies whose inverse mass has
/// a norm below SIMD_EPSILON (btVector3::fuzzyZero): from 1.45e7 kg in 3D, from 1.19e7 kg in the plane. Far below
/// 1e-4 kg, products of inverse masses leave single precision's range.
inline constexpr double least_plain_mass = 0.01;  // of the heaviest shape; the lightest weighs a hundredth or more
inline constexpr double most_plain_mass = 1e6;

/// Factor of all masses and inertias that go into Bullet, and so of all impulses that come out. A power of two, which
/// changes no bit of the motion; 1 where the heaviest shape lies within the limits above.
template <int Dim>
double mass_scale(std::span<const Shape<Dim>> shapes);

}  // namespace talus::bullet
