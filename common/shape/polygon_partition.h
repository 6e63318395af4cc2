#pragma once
// Polygons that are not convex, cut into pieces that engines can take.

#include <span>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Cuts a simple polygon into strictly convex ones of at most 8 corners each, counter-clockwise, along diagonals only:
/// no new corners, and the areas add up to the whole. Corners in the middle of a straight edge are left out. At most
/// four times as many pieces as the least possible number (Hertel and Mehlhorn 1983), but for the limit of 8 corners.
/// Throws as check_simple_polygon() does, and where the polygon is too thin to cut.
std::vector<std::vector<Vec2>> convex_partition(std::span<const Vec2> corners);

}  // namespace talus
