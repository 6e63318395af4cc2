#pragma once
// The shapes that scene files name. Each function returns the pieces for make_shape(); lengths in metres.

#include <span>
#include <vector>

#include "common/shape/shape.h"

namespace talus {

/// Two arms of one thickness that meet in a corner, as in the paper's examples 1, 3 and 5.
struct LParams {
  double arm_x = 1.0;      // outer length of the lying arm [m], > thickness
  double arm_z = 1.0;      // outer length of the standing arm [m], > thickness
  double thickness = 0.4;  // of both arms [m], > 0; a thin L interlocks more and needs a smaller time step
  double depth = 0.4;      // along y, 3D only [m], > 0
};

/// The paper's O: a ring standing in the x-z plane around the origin, in straight parts that meet on slanted cuts.
struct RingParams {
  double outer_radius = 1.0;  // of the circle that the parts' outer corners lie on [m], > inner_radius
  double inner_radius = 0.6;  // of the hole [m], > 0
  // Parts around, 3 to 64. Every part is a shape of its own to the engine: what a ring costs in contact grows with
  // them, in piles nearly in proportion. With few the ring is angular: the hole narrows to inner_radius cos(pi /
  // parts).
  int parts = 8;
  // Corners of the tube's section, 3D only: 4 (a rectangle), 6 or 8. Each is another pair of corners in every part.
  int section_corners = 4;
  double depth = 0.0;  // along y, 3D only [m], >= 0; 0: the section is a regular polygon, as deep as the tube is wide
};

template <int Dim>
std::vector<Piece<Dim>> box_pieces(const Vec<Dim>& size);
template <int Dim>
std::vector<Piece<Dim>> l_pieces(const LParams& params);
template <int Dim>
std::vector<Piece<Dim>> ball_pieces(double radius);
/// Capsule along x; `length` from tip to tip [m], > 2 radius.
template <int Dim>
std::vector<Piece<Dim>> capsule_pieces(double length, double radius);
/// 2D: corners of a convex polygon in order, either way round, 3 to 8. 3D: any points; their convex hull.
/// A 2D polygon that is not convex is refused, never replaced by its hull.
template <int Dim>
std::vector<Piece<Dim>> hull_pieces(std::span<const Vec<Dim>> corners);
/// Any simple polygon, convex or not, cut by convex_partition(). Corners (x, z) in order, either way round; in 3D drawn
/// out along y to `depth` [m], half of it to each side.
template <int Dim>
std::vector<Piece<Dim>> polygon_pieces(std::span<const Vec2> corners, double depth = 0.4);
template <int Dim>
std::vector<Piece<Dim>> ring_pieces(const RingParams& params);

}  // namespace talus
