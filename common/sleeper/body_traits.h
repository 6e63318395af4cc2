#pragma once
// The data of a body that a sleeper needs besides its motion.

#include <vector>

#include "common/shape/shape.h"

namespace talus {

template <int Dim>
struct BodyTraits {
  double mass = 0.0;                            // [kg] > 0; of a kinematic body it means nothing
  Inertia<Dim> inertia = Inertia<Dim>::Zero();  // about the centre of mass, in the body's own axes [kg m^2]
  Box<Dim> bounds = {};                         // in the body's own axes, around the centre of mass: 0 lies in it [m]
  double friction = 0.5;                        // of its surface against one like it
  std::vector<Piece<Dim>> pieces = {};          // convex, in the same axes; empty: the box of `bounds`

  /// For an axis about which the body cannot turn: so large that a contact hardly turns it [kg m^2].
  double locked_inertia() const { return 1e6 * mass * bounds.diagonal().squaredNorm(); }
};

/// Adds a piece for BodyTraits::pieces, unless it is one that no shape of talus has, such as one without volume.
template <int Dim>
void add_piece(const Piece<Dim>& piece, std::vector<Piece<Dim>>& pieces);

/// A box of uniform density; `size` [m].
template <int Dim>
BodyTraits<Dim> box_traits(double mass, const Vec<Dim>& size);
/// A ball, in 2D a disc, of uniform density; `radius` [m].
template <int Dim>
BodyTraits<Dim> ball_traits(double mass, double radius);
/// A shape of talus.
template <int Dim>
BodyTraits<Dim> traits_of(const Shape<Dim>& shape);

/// The traits as a shape. Throws InvalidValue.
template <int Dim>
Shape<Dim> shape_with(const BodyTraits<Dim>& traits, bool kinematic);

}  // namespace talus
