#pragma once
// The shapes that scene files name. Each function returns the pieces for make_shape(); lengths in metres.

#include <array>
#include <random>
#include <span>
#include <vector>

#include "common/params/field.h"
#include "common/shape/shape.h"

namespace talus {

template <int Dim>
struct BoxParams {
  Vec<Dim> size = Vec<Dim>::Ones();
};

template <int Dim>
inline constexpr auto box_fields = std::to_array<Field<BoxParams<Dim>>>({
    {&BoxParams<Dim>::size,
     {.name = "size",
      .required = true,
      .type = "lengths",
      .unit = "m",
      .range = length_range,
      .meaning = "full width along each axis"}},
});

/// Two arms of one thickness that meet in a corner, as in the paper's examples 1, 3 and 5.
struct LParams {
  double arm_x = 1.0;
  double arm_z = 1.0;
  double thickness = 0.4;
  double depth = 0.4;
};

inline constexpr auto l_fields = std::to_array<Field<LParams>>({
    {&LParams::arm_x,
     {.name = "arm_x",
      .unit = "m",
      .range = length_range,
      .further_rule = "above `thickness`",
      .meaning = "outer length of the horizontal arm"}},
    {&LParams::arm_z,
     {.name = "arm_z",
      .unit = "m",
      .range = length_range,
      .further_rule = "above `thickness`",
      .meaning = "outer length of the vertical arm"}},
    {&LParams::thickness,
     {.name = "thickness",
      .unit = "m",
      .range = length_range,
      .meaning = "of both arms. A thin L interlocks more and needs smaller time steps"}},
    {&LParams::depth,
     {.name = "depth",
      .dimension = 3,
      .unit = "m",
      .range = length_range,
      .meaning = "along y, half of it to each side"}},
});

struct BallParams {
  double radius = 0.5;
};

inline constexpr auto ball_fields = std::to_array<Field<BallParams>>({
    {&BallParams::radius,
     {.name = "radius", .required = true, .unit = "m", .range = length_range, .meaning = "in 2D of a disc"}},
});

struct CapsuleParams {
  double length = 1.0;
  double radius = 0.25;
};

inline constexpr auto capsule_fields = std::to_array<Field<CapsuleParams>>({
    {&CapsuleParams::length,
     {.name = "length",
      .required = true,
      .unit = "m",
      .range = length_range,
      .further_rule = "above 2 `radius`",
      .meaning = "from tip to tip, along x"}},
    {&CapsuleParams::radius,
     {.name = "radius", .required = true, .unit = "m", .range = length_range, .meaning = "of the two ends"}},
});

/// An upright cylinder as a prism.
struct CylinderParams {
  double length = 1.0;
  double radius = 0.5;
  int sides = 16;
};

inline constexpr auto cylinder_fields = std::to_array<Field<CylinderParams>>({
    {&CylinderParams::length,
     {.name = "length", .required = true, .unit = "m", .range = length_range, .meaning = "along z"}},
    {&CylinderParams::radius,
     {.name = "radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "of the circle on which the corners of the prism lie; in 2D half the width of a rectangle"}},
    {&CylinderParams::sides,
     {.name = "sides",
      .dimension = 3,
      .range = between(3.0, 64.0),
      .meaning =
          "flat sides around. Few: it does not roll; many: contacts cost more. With 16 its volume is 2.6 % below "
          "that of the round cylinder"}},
});

/// An upright cone as a pyramid.
struct ConeParams {
  double height = 1.0;
  double radius = 0.5;
  int sides = 16;
};

inline constexpr auto cone_fields = std::to_array<Field<ConeParams>>({
    {&ConeParams::height,
     {.name = "height", .required = true, .unit = "m", .range = length_range, .meaning = "along z, the tip on top"}},
    {&ConeParams::radius,
     {.name = "radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "of the circle on which the corners of the base lie; in 2D half the base of a triangle"}},
    {&ConeParams::sides,
     {.name = "sides",
      .dimension = 3,
      .range = between(3.0, 64.0),
      .meaning = "flat sides around. Few: it does not roll; many: contacts cost more"}},
});

/// An ellipse, in 3D an ellipsoid, with flat sides.
template <int Dim>
struct EllipseParams {
  Vec<Dim> size = Vec<Dim>::Ones();
  int corners = Dim == 2 ? 16 : 42;
};

template <int Dim>
inline constexpr auto ellipse_fields = std::to_array<Field<EllipseParams<Dim>>>({
    {&EllipseParams<Dim>::size,
     {.name = "size",
      .required = true,
      .type = "lengths",
      .unit = "m",
      .range = length_range,
      .meaning = "full width along each axis of the ellipse, in 3D the ellipsoid, on which the corners lie"}},
    {&EllipseParams<Dim>::corners,
     {.name = "corners",
      .range = between(6.0, 200.0),
      .default_text = "16 in 2D, 42 in 3D",
      .meaning = "Few: it does not roll; many: contacts cost more. In 2D each six of them are one more piece; 16 "
                 "corners leave out 2.6 % of the area, 42 in 3D 14 % of the volume"}},
});

/// A random convex polygon or polyhedron.
struct StoneParams {
  double size = 1.0;
  double elongation = 1.3;
  double roughness = 0.2;
  int corners = 0;  // 0: 7 in 2D, 16 in 3D
  int variants = 8;
};

inline constexpr auto stone_fields = std::to_array<Field<StoneParams>>({
    {&StoneParams::size,
     {.name = "size",
      .unit = "m",
      .range = length_range,
      .meaning = "diameter of the disc or ball of the area or volume of the ellipse or ellipsoid that it is cut from"}},
    {&StoneParams::elongation,
     {.name = "elongation",
      .range = between(1.0, 5.0),
      .meaning = "length over width of that ellipse or, with two equal short axes, ellipsoid"}},
    {&StoneParams::roughness,
     {.name = "roughness",
      .range = between(0.0, 0.9),
      .meaning = "each corner lies inwards by a random share of up to this. Corners that are not convex are left out"}},
    {&StoneParams::corners,
     {.name = "corners",
      .range = between(5.0, 64.0),
      .further_rule = "at most 8 in 2D",
      .default_text = "7 in 2D, 16 in 3D",
      .meaning = "random points on the ellipse or ellipsoid"}},
    {&StoneParams::variants,
     {.name = "variants",
      .range = between(1.0, 100.0),
      .meaning =
          "different stones, which sources drop in turn. All follow from the scene's `seed`; a `[[body]]` and an "
          "obstacle are the first of them"}},
});

template <int Dim>
struct HullParams {
  std::vector<Vec<Dim>> corners;
};

template <int Dim>
inline constexpr auto hull_fields = std::to_array<Field<HullParams<Dim>>>({
    {&HullParams<Dim>::corners,
     {.name = "corners",
      .required = true,
      .unit = "m",
      .range = coordinate_range,
      .meaning =
          "2D: 3 to 8 corners of a convex polygon in order, clockwise or counter-clockwise; one that is not convex "
          "is refused. 3D: four points or more, not in one plane; the shape is their convex hull"}},
});

struct PolygonParams {
  std::vector<Vec2> corners;
  double depth = 0.4;
};

inline constexpr auto polygon_fields = std::to_array<Field<PolygonParams>>({
    {&PolygonParams::corners,
     {.name = "corners",
      .required = true,
      .unit = "m",
      .range = coordinate_range,
      .meaning = "three or more points `[x, z]` in order, convex or not, no edge touching another; cut into convex "
                 "pieces of at most 8 corners"}},
    {&PolygonParams::depth,
     {.name = "depth",
      .dimension = 3,
      .unit = "m",
      .range = length_range,
      .meaning = "along y, half of it to each side"}},
});

/// The paper's O: a ring standing in the x-z plane around the origin, in straight parts that meet on slanted cuts.
struct RingParams {
  double outer_radius = 1.0;
  double inner_radius = 0.6;
  int parts = 8;
  int section_corners = 4;
  double depth = 0.0;  // [m]; 0: the section is a regular polygon, as deep as the tube is wide
};

inline constexpr auto ring_fields = std::to_array<Field<RingParams>>({
    {&RingParams::outer_radius,
     {.name = "outer_radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "of the circle, in the x-z plane, on which the outer corners of the parts lie"}},
    {&RingParams::inner_radius,
     {.name = "inner_radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .further_rule = "below `outer_radius`",
      .meaning = "of the circle on which the inner corners lie"}},
    {&RingParams::parts,
     {.name = "parts",
      .range = between(3.0, 64.0),
      .meaning = "convex parts around. In a pile a ring's cost grows nearly in proportion; few parts make it angular, "
                 "and the hole narrower by cos(180 degrees / `parts`)"}},
    {&RingParams::depth,
     {.name = "depth",
      .dimension = 3,
      .unit = "m",
      .range = length_range,
      .default_text = "width of the tube",
      .meaning = "along y, half of it to each side"}},
    {&RingParams::section_corners,
     {.name = "section_corners",
      .dimension = 3,
      .range = between(4.0, 8.0),
      .further_rule = "4, 6 or 8",
      .meaning = "corners of the tube's section; more are rounder and cost more"}},
});

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
