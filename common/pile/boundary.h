#pragma once
// Walls that a pile cannot pass (section 3.5).

#include <span>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Point on a horizontal cut: x in 2D, (x, y) in 3D.
template <int Dim>
using Horizontal = Eigen::Matrix<double, Dim - 1, 1>;

/// A wall: the pile stays where normal . (p - centre) <= distance.
template <int Dim>
struct Wall {
  Horizontal<Dim> normal = Horizontal<Dim>::UnitX();  // unit, outwards
  double distance = 1.0;                              // from the pile's centre [m], > 0
};

/// The container around a pile's centre: convex, the same at all heights up to its rim. Either a cylinder or walls.
template <int Dim>
struct Boundary {
  double rim = 1.0;                // height of the walls above the pile's base [m], > 0
  double cylinder_radius = 0.0;    // [m]; > 0: a cylinder, 3D only
  std::vector<Wall<Dim>> walls{};  // otherwise: closed all around

  /// 0 at the centre, 1 at the wall, and in proportion between (the region's Minkowski functional).
  double gauge(const Horizontal<Dim>& from_centre) const;
  /// Distance from the centre to the nearest wall [m].
  double inner_radius() const;
  /// Area within [m^2], in 2D length [m]. Throws std::invalid_argument where the walls do not close.
  double area() const;
};

/// Rectangle (in 2D interval) of full `size` around the centre.
template <int Dim>
Boundary<Dim> box_boundary(const Horizontal<Dim>& size, double rim);

/// The sides of a convex polygon, counter-clockwise, around the centre, its origin. Throws InvalidValue if the origin
/// is not inside.
Boundary<3> convex_boundary(std::span<const Vec2> outline, double rim);

}  // namespace talus
