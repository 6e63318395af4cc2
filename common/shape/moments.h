#pragma once
// Volume, centre and second moments: the integrals from which masses and inertias of every piece follow.

#include <array>
#include <span>

#include "common/shape/shape.h"

namespace talus {

/// Integrals of 1, x and (x - centre)(x - centre)^T over a region of unit density.
template <int Dim>
struct Moments {
  double volume = 0.0;                                                // [m^3], in 2D [m^2]
  Vec<Dim> centre = Vec<Dim>::Zero();                                 // [m]
  Eigen::Matrix<double, Dim, Dim> second = decltype(second)::Zero();  // about `centre` [m^5], in 2D [m^4]

  /// Adds a region that does not overlap this one.
  Moments& operator+=(const Moments& other);

  /// Inertia about `centre`: trace(second) 1 - second in 3D, trace(second) in 2D.
  Inertia<Dim> inertia() const;
};

/// Exact up to rounding for every kind of piece. The piece must have passed check_piece().
template <int Dim>
Moments<Dim> moments(const Piece<Dim>& piece);

/// The same of what a closed boundary encloses: edges counter-clockwise in 2D, triangles counter-clockwise seen from
/// outside in 3D, given as indices of corners.
template <int Dim>
Moments<Dim> moments_within(std::span<const Vec<Dim>> corners, std::span<const std::array<int, Dim>> boundary);

}  // namespace talus
