#pragma once

#include "common/shape/shape.h"
#include "common/world/world.h"

namespace talus {

/// Kinetic energy of one body [J]: of its translation and of its rotation.
template <int Dim>
double kinetic_energy(const Shape<Dim>& shape, const Rotation<Dim>& rotation, const Vec<Dim>& velocity,
                      const Spin<Dim>& spin) {
  const double translation = shape.mass * velocity.squaredNorm();
  if constexpr (Dim == 2) {
    return 0.5 * (translation + shape.inertia(0, 0) * spin.squaredNorm());
  } else {
    const Vec3 own = rotation.inverse() * spin;  // the inertia is given in the body's own axes
    return 0.5 * (translation + own.dot(shape.inertia * own));
  }
}

/// Kinetic energy of body `i` of `states` [J].
template <int Dim>
double kinetic_energy(const Shape<Dim>& shape, const BodyStates<Dim>& states, BodyIndex i) {
  return kinetic_energy<Dim>(shape, states.pose[i].rotation, states.velocity[i], states.spin[i]);
}

/// Kinetic energy of a body [J].
template <int Dim>
double kinetic_energy(const World<Dim>& world, BodyIndex body) {
  return kinetic_energy(world.shape_of(body), world.states(), body);
}

/// Kinetic energy of the awake bodies [J]; sleeping ones have none.
template <int Dim>
double kinetic_energy(const World<Dim>& world) {
  double energy = 0.0;
  for (const BodyIndex body : world.awake()) energy += kinetic_energy(world, body);
  return energy;
}

}  // namespace talus
