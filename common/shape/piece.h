#pragma once
// The convex pieces that shapes are made of. What depends on the kind of a piece is here, in moments.h (exact
// integrals), in surface.h (what is drawn), in the translation to messages and in each engine's body_template.cc.

#include <string>
#include <variant>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// All points within `radius` of the convex hull of `corners`: with a radius a ball (one corner; a disc in 2D) or a
/// capsule (two corners), without one a convex polygon (2D: 3 to 8 corners, counter-clockwise) or polyhedron (3D: 4
/// corners or more, in any order).
template <int Dim>
struct HullPiece {
  std::vector<Vec<Dim>> corners;  // [m]
  double radius = 0.0;            // [m]

  /// Whether it is a ball or a capsule.
  bool round() const { return corners.size() <= 2; }
};

/// Box (rectangle in 2D), turned and placed within the shape. A kind of its own: engines and messages have one, and its
/// sizes and axes could be computed from corners only with rounding errors.
template <int Dim>
struct BoxPiece {
  Pose<Dim> pose;
  Vec<Dim> half = Vec<Dim>::Constant(0.5);  // [m], > 0 on every axis
};

template <int Dim>
using Piece = std::variant<BoxPiece<Dim>, HullPiece<Dim>>;

/// The corners and the radius of the same piece as a hull. Those of a rectangle are counter-clockwise.
template <int Dim>
HullPiece<Dim> as_hull(const Piece<Dim>& piece);

/// Moves the piece without turning it.
template <int Dim>
void translate(Piece<Dim>& piece, const Vec<Dim>& by);

/// The piece as it is where the axes that it is described in come to `pose`.
template <int Dim>
Piece<Dim> placed(const Piece<Dim>& piece, const Pose<Dim>& pose);

/// Makes the piece `factor` times as large, seen from the origin.
template <int Dim>
void scale(Piece<Dim>& piece, double factor);

/// The smallest axis-aligned box around a piece that is turned about the origin, then moved [m].
template <int Dim>
Box<Dim> bounds_of(const Piece<Dim>& piece, const Eigen::Matrix<double, Dim, Dim>& turn, const Vec<Dim>& position);

/// Distance from the origin to the farthest point of the piece [m].
template <int Dim>
double reach_of(const Piece<Dim>& piece);

/// The least distance between two parallel lines or planes that hold the piece [m]. For hulls in 3D only planes along
/// a face are tried. What engines need to be large beside their contact skin.
template <int Dim>
double smallest_width(const Piece<Dim>& piece);

/// Throws std::invalid_argument with field (beginning with `field`), value and rule on a non-finite value, on a size
/// that is not positive, and on corners that are too few, too many (2D), on one line or in one plane, or not convex.
template <int Dim>
void check_piece(const Piece<Dim>& piece, const std::string& field);

/// Throws unless the corners are enough for a polygon or polyhedron, and in 2D not too many.
template <int Dim>
void check_corner_count(std::size_t count, const std::string& field);

/// Throws unless the rotation is finite and, in 3D, its quaternion of length 1.
template <int Dim>
void check_rotation(const Rotation<Dim>& rotation, const std::string& field);

}  // namespace talus
