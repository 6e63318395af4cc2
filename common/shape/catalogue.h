#pragma once
// The shapes that scene files name. Each function returns the pieces for make_shape(); lengths in metres.

#include <random>
#include <span>
#include <vector>

#include "common/shape/shape.h"

namespace talus {

template <int Dim>
struct BoxParams {
  Vec<Dim> size = Vec<Dim>::Ones();
};

/// Two arms of one thickness that meet in a corner, as in the paper's examples 1, 3 and 5.
struct LParams {
  double arm_x = 1.0;
  double arm_z = 1.0;
  double thickness = 0.4;
  double depth = 0.4;
};

struct BallParams {
  double radius = 0.5;
};

struct CapsuleParams {
  double length = 1.0;
  double radius = 0.25;
};

/// An upright cylinder as a prism.
struct CylinderParams {
  double length = 1.0;
  double radius = 0.5;
  int sides = 16;
};

/// An upright cone as a pyramid.
struct ConeParams {
  double height = 1.0;
  double radius = 0.5;
  int sides = 16;
};

/// An ellipse, in 3D an ellipsoid, with flat sides.
template <int Dim>
struct EllipseParams {
  Vec<Dim> size = Vec<Dim>::Ones();
  int corners = Dim == 2 ? 16 : 42;
};

/// A random convex polygon or polyhedron.
struct StoneParams {
  double size = 1.0;
  double elongation = 1.3;
  double roughness = 0.2;
  int corners = 0;  // 0: 7 in 2D, 16 in 3D
  int variants = 8;
};

template <int Dim>
struct HullParams {
  std::vector<Vec<Dim>> corners;
};

struct PolygonParams {
  std::vector<Vec2> corners;
  double depth = 0.4;
};

/// The paper's O: a ring standing in the x-z plane around the origin, in straight parts that meet on slanted cuts.
struct RingParams {
  double outer_radius = 1.0;
  double inner_radius = 0.6;
  int parts = 8;
  int section_corners = 4;
  double depth = 0.0;  // [m]; 0: the section is a regular polygon, as deep as the tube is wide
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
/// Upright prism of regular base around the origin; in 2D a rectangle.
template <int Dim>
std::vector<Piece<Dim>> cylinder_pieces(const CylinderParams& params);
/// Upright pyramid of regular base around the origin, which halves its height; in 2D a triangle.
template <int Dim>
std::vector<Piece<Dim>> cone_pieces(const ConeParams& params);
/// Corners on the ellipse or ellipsoid around the origin, evenly spaced; in 2D cut into convex pieces.
template <int Dim>
std::vector<Piece<Dim>> ellipse_pieces(const EllipseParams<Dim>& params);
/// The long axis is x.
template <int Dim>
std::vector<Piece<Dim>> stone_pieces(const StoneParams& params, std::mt19937_64& random);
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
