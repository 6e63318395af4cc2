#pragma once
// The keys of materials and of the shapes of the catalogue.

#include <array>

#include "common/params/field.h"
#include "common/shape/catalogue.h"

namespace talus {

inline constexpr auto surface_fields = std::to_array<Field<Material>>({
    {place_of<&Material::friction>,
     {.name = "friction",
      .range = between(0.0, 1e3),
      .meaning = "Coulomb's coefficient; see [conventions](#conventions) on pairs. Few real materials are above 1"}},
    {place_of<&Material::restitution>,
     {.name = "restitution",
      .range = between(0.0, 1.0),
      .meaning =
          "share of the approach speed given back. Above 0.99 impacts may add energy with the engines' own solvers"}},
});

/// What only bodies have.
inline constexpr auto body_material_fields = std::to_array<Field<Material>>({
    {place_of<&Material::density>,
     {.name = "density",
      .unit = "kg/m^3, in 2D kg/m^2",
      .range = above(0.0, 1e6),
      .meaning =
          "only ratios matter to a pile: masses of a scene's shapes must be within a factor of 100, with the engines' "
          "own solvers better 10. Mass and inertia must be at least 1e-20 kg and kg m^2"}},
    {place_of<&Material::rolling_friction>,
     {.name = "rolling_friction",
      .range = between(0.0, 10.0),
      .meaning = "tangent of the steepest slope on which a ball of this shape does not roll. Each contact resists "
                 "turning, rolling as well as spinning, by a torque of up to this times the normal force times half "
                 "the width of the thinnest part; two bodies take the geometric mean of both. Without it heaps of "
                 "balls and discs do not come to rest. Only with the solver `small_steps`"}},
});

template <int Dim>
inline constexpr auto box_fields = std::to_array<Field<BoxParams<Dim>>>({
    {place_of<&BoxParams<Dim>::size>,
     {.name = "size",
      .required = true,
      .type = "lengths",
      .unit = "m",
      .range = length_range,
      .meaning = "full width along each axis"}},
});

inline constexpr auto l_fields = std::to_array<Field<LParams>>({
    {place_of<&LParams::arm_x>,
     {.name = "arm_x",
      .unit = "m",
      .range = length_range,
      .further_rule = "above `thickness`",
      .meaning = "outer length of the horizontal arm"}},
    {place_of<&LParams::arm_z>,
     {.name = "arm_z",
      .unit = "m",
      .range = length_range,
      .further_rule = "above `thickness`",
      .meaning = "outer length of the vertical arm"}},
    {place_of<&LParams::thickness>,
     {.name = "thickness",
      .unit = "m",
      .range = length_range,
      .meaning = "of both arms. A thin L interlocks more and needs smaller time steps"}},
    {place_of<&LParams::depth>,
     {.name = "depth",
      .dimension = 3,
      .unit = "m",
      .range = length_range,
      .meaning = "along y, half of it to each side"}},
});

inline constexpr auto ball_fields = std::to_array<Field<BallParams>>({
    {place_of<&BallParams::radius>,
     {.name = "radius", .required = true, .unit = "m", .range = length_range, .meaning = "in 2D of a disc"}},
});

inline constexpr auto capsule_fields = std::to_array<Field<CapsuleParams>>({
    {place_of<&CapsuleParams::length>,
     {.name = "length",
      .required = true,
      .unit = "m",
      .range = length_range,
      .further_rule = "above 2 `radius`",
      .meaning = "from tip to tip, along x"}},
    {place_of<&CapsuleParams::radius>,
     {.name = "radius", .required = true, .unit = "m", .range = length_range, .meaning = "of the two ends"}},
});

inline constexpr auto cylinder_fields = std::to_array<Field<CylinderParams>>({
    {place_of<&CylinderParams::length>,
     {.name = "length", .required = true, .unit = "m", .range = length_range, .meaning = "along z"}},
    {place_of<&CylinderParams::radius>,
     {.name = "radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "of the circle on which the corners of the prism lie; in 2D half the width of a rectangle"}},
    {place_of<&CylinderParams::sides>,
     {.name = "sides",
      .dimension = 3,
      .range = between(3.0, 64.0),
      .meaning =
          "flat sides around. Few: it does not roll; many: contacts cost more. With 16 its volume is 2.6 % below "
          "that of the round cylinder"}},
});

inline constexpr auto cone_fields = std::to_array<Field<ConeParams>>({
    {place_of<&ConeParams::height>,
     {.name = "height", .required = true, .unit = "m", .range = length_range, .meaning = "along z, the tip on top"}},
    {place_of<&ConeParams::radius>,
     {.name = "radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "of the circle on which the corners of the base lie; in 2D half the base of a triangle"}},
    {place_of<&ConeParams::sides>,
     {.name = "sides",
      .dimension = 3,
      .range = between(3.0, 64.0),
      .meaning = "flat sides around. Few: it does not roll; many: contacts cost more"}},
});

template <int Dim>
inline constexpr auto ellipse_fields = std::to_array<Field<EllipseParams<Dim>>>({
    {place_of<&EllipseParams<Dim>::size>,
     {.name = "size",
      .required = true,
      .type = "lengths",
      .unit = "m",
      .range = length_range,
      .meaning = "full width along each axis of the ellipse, in 3D the ellipsoid, on which the corners lie"}},
    {place_of<&EllipseParams<Dim>::corners>,
     {.name = "corners",
      .range = between(6.0, 200.0),
      .default_text = "16 in 2D, 42 in 3D",
      .meaning = "Few: it does not roll; many: contacts cost more. In 2D each six of them are one more piece; 16 "
                 "corners leave out 2.6 % of the area, 42 in 3D 14 % of the volume"}},
});

inline constexpr auto stone_fields = std::to_array<Field<StoneParams>>({
    {place_of<&StoneParams::size>,
     {.name = "size",
      .unit = "m",
      .range = length_range,
      .meaning = "diameter of the disc or ball of the area or volume of the ellipse or ellipsoid that it is cut from"}},
    {place_of<&StoneParams::elongation>,
     {.name = "elongation",
      .range = between(1.0, 5.0),
      .meaning = "length over width of that ellipse or, with two equal short axes, ellipsoid"}},
    {place_of<&StoneParams::roughness>,
     {.name = "roughness",
      .range = between(0.0, 0.9),
      .meaning = "each corner lies inwards by a random share of up to this. Corners that are not convex are left out"}},
    {place_of<&StoneParams::corners>,
     {.name = "corners",
      .range = between(5.0, 64.0),
      .further_rule = "at most 8 in 2D",
      .default_text = "7 in 2D, 16 in 3D",
      .meaning = "random points on the ellipse or ellipsoid"}},
    {place_of<&StoneParams::variants>,
     {.name = "variants",
      .range = between(1.0, 100.0),
      .meaning =
          "different stones, which sources drop in turn. All follow from the scene's `seed`; a `[[body]]` and an "
          "obstacle are the first of them"}},
});

template <int Dim>
inline constexpr auto hull_fields = std::to_array<Field<HullParams<Dim>>>({
    {place_of<&HullParams<Dim>::corners>,
     {.name = "corners",
      .required = true,
      .unit = "m",
      .range = coordinate_range,
      .meaning =
          "2D: 3 to 8 corners of a convex polygon in order, clockwise or counter-clockwise; one that is not convex "
          "is refused. 3D: four points or more, not in one plane; the shape is their convex hull"}},
});

inline constexpr auto polygon_fields = std::to_array<Field<PolygonParams>>({
    {place_of<&PolygonParams::corners>,
     {.name = "corners",
      .required = true,
      .unit = "m",
      .range = coordinate_range,
      .meaning = "three or more points `[x, z]` in order, convex or not, no edge touching another; cut into convex "
                 "pieces of at most 8 corners"}},
    {place_of<&PolygonParams::depth>,
     {.name = "depth",
      .dimension = 3,
      .unit = "m",
      .range = length_range,
      .meaning = "along y, half of it to each side"}},
});

inline constexpr auto ring_fields = std::to_array<Field<RingParams>>({
    {place_of<&RingParams::outer_radius>,
     {.name = "outer_radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "of the circle, in the x-z plane, on which the outer corners of the parts lie"}},
    {place_of<&RingParams::inner_radius>,
     {.name = "inner_radius",
      .required = true,
      .unit = "m",
      .range = length_range,
      .further_rule = "below `outer_radius`",
      .meaning = "of the circle on which the inner corners lie"}},
    {place_of<&RingParams::parts>,
     {.name = "parts",
      .range = between(3.0, 64.0),
      .meaning = "convex parts around. In a pile a ring's cost grows nearly in proportion; few parts make it angular, "
                 "and the hole narrower by cos(180 degrees / `parts`)"}},
    {place_of<&RingParams::depth>,
     {.name = "depth",
      .dimension = 3,
      .unit = "m",
      .range = length_range,
      .default_text = "width of the tube",
      .meaning = "along y, half of it to each side"}},
    {place_of<&RingParams::section_corners>,
     {.name = "section_corners",
      .dimension = 3,
      .range = between(4.0, 8.0),
      .further_rule = "4, 6 or 8",
      .meaning = "corners of the tube's section; more are rounder and cost more"}},
});

}  // namespace talus
