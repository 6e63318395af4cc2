#pragma once
// What formats of space show of either dimension: a scene in 2D lies in the plane y = 0.

#include <string>
#include <vector>

#include "common/shape/surface.h"

namespace talus {

inline Pose<3> in_space(const Pose<3>& pose) { return pose; }
inline Pose<3> in_space(const Pose<2>& pose) {
  // Counter-clockwise with x to the right and z up is about -y.
  return {{pose.position.x(), 0.0, pose.position.y()},
          Rotation<3>(Eigen::AngleAxisd(pose.rotation.angle(), -Vec3::UnitY()))};
}

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
