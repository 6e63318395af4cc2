#pragma once
// Plane geometry of polygons given by their corners in order, the last joined to the first.

#include <optional>
#include <span>
#include <string>

#include "common/math/vector.h"

namespace talus {

/// Most corners of one convex polygon: Box2D's limit (b2_maxPolygonVertices).
inline constexpr std::size_t most_corners = 8;

/// Share of its own length by which a thing must differ from a point, line or plane to have a volume to compute with.
inline constexpr double flatness = 1e-6;

/// Positive when the corners run counter-clockwise [m^2].
double signed_area(std::span<const Vec2> corners);

/// Twice the area of a triangle, positive when its corners run counter-clockwise [m^2].
double cross(const Vec2& origin, const Vec2& a, const Vec2& b);

/// Distance of a point from the line through two others, positive to its left [m].
double distance_from_line(const Vec2& point, const Vec2& from, const Vec2& to);

/// A corner that keeps the polygon from being strictly convex, counter-clockwise and wound around once, if there is
/// one.
std::optional<std::size_t> non_convex_corner(std::span<const Vec2> corners);

/// "(x, z)", for messages.
std::string text(const Vec2& corner);

/// Unit normal, pointing outwards, of the side that begins at a corner of a counter-clockwise polygon.
Vec2 outward_normal(std::span<const Vec2> corners, std::size_t from);

/// Throws std::invalid_argument with field, value and rule unless the corners, in order and either way round, make a
/// simple polygon: at least 3, finite, no edge touching another but its neighbours in their common corner.
void check_simple_polygon(std::span<const Vec2> corners);

}  // namespace talus
