#include "tools/export/solid.h"

namespace talus {
namespace {

constexpr int segments_of_round = 24;

/// Twice the area, along the normal of a convex polygon.
Vec3 area_vector(const Loop<3>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum;
}

}  // namespace

std::vector<Loop<3>> polygons_in_space(const Shape<2>& shape) {
  std::vector<Loop<3>> polygons;
  for (const Loop<2>& outline : outlines(shape, segments_of_round)) {
    Loop<3>& polygon = polygons.emplace_back();
    for (const Vec2& corner : outline) polygon.emplace_back(corner.x(), 0.0, corner.y());
  }
  return polygons;
}

std::vector<Loop<3>> polygons_in_space(const Shape<3>& shape) { return faces(shape, segments_of_round); }

TriangleMesh triangles_of(const std::vector<Loop<3>>& polygons) {
  TriangleMesh mesh;
  for (const Loop<3>& polygon : polygons) {
    if (area_vector(polygon).norm() == 0.0) continue;
    const int first = static_cast<int>(mesh.corners.size());
    const int corners = static_cast<int>(polygon.size());
    mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
    for (int i = 2; i < corners; ++i) mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
  }
  return mesh;
}

}  // namespace talus
