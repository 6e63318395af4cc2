#pragma once
// The convex hull of points in space, by qhull.

#include <span>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Faces of the convex hull: indices of points, counter-clockwise seen from outside; coplanar triangles are one face.
/// The same points give the same faces in the same order. No faces when the points (fewer than four, or all in one
/// plane) span no volume.
std::vector<std::vector<int>> convex_hull_faces(std::span<const Vec3> points);

}  // namespace talus
