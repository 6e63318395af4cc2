#pragma once
// What formats of space show of either dimension: a scene in 2D lies in the plane y = 0.

#include <vector>

#include "common/math/in_space.h"
#include "common/shape/surface.h"

namespace talus {

/// The surface of a shape in its own axes; round parts have 24 corners for a full turn.
std::vector<Loop<3>> polygons_in_space(const Shape<2>& shape);
std::vector<Loop<3>> polygons_in_space(const Shape<3>& shape);

/// The corners of all polygons, and the triangles that fill them.
struct TriangleMesh {
  std::vector<Vec3> corners;  // of each polygon apart
  std::vector<int> indices;   // three for each triangle
};
TriangleMesh triangles_of(const std::vector<Loop<3>>& polygons);

}  // namespace talus
