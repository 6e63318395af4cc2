#include "tools/mesh/convex_parts.h"

#include <hacdHACD.h>

#include <limits>

#include "common/math/require.h"
#include "common/mesh/mesh_repair.h"
#include "common/shape/convex_hull.h"

namespace talus {
namespace {

using Point = HACD::Vec3<HACD::Real>;
using Indices = HACD::Vec3<long>;

// HACD's own triangles are not needed: the hull of its points is the part.
Mesh hull_of(const std::vector<Point>& points) {
  Mesh part;
  for (const Point& point : points) {
    part.corners.emplace_back(point.X(), point.Y(), point.Z());
  }
  for (const std::vector<int>& face : convex_hull_faces(part.corners)) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      part.triangles.push_back({face[0], face[i], face[i + 1]});
    }
  }
  return part;
}

}  // namespace

std::vector<Mesh> convex_parts(const Mesh& mesh, const ConvexPartsParams& params) {
  require(params.parts >= 1 && params.parts <= 64, "parts", params.parts, "must be in 1..64");
  require(params.corners >= 4 && params.corners <= 128, "corners", params.corners, "must be in 4..128");
  std::vector<Point> points;
  points.reserve(mesh.corners.size());
  for (const Vec3& corner : mesh.corners) {
    points.emplace_back(corner.x(), corner.y(), corner.z());
  }
  std::vector<Indices> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    triangles.emplace_back(triangle[0], triangle[1], triangle[2]);
  }
  HACD::HACD decomposition;
  decomposition.SetPoints(points.data());
  decomposition.SetNPoints(points.size());
  decomposition.SetTriangles(triangles.data());
  decomposition.SetNTriangles(triangles.size());
  decomposition.SetNClusters(static_cast<std::size_t>(params.parts));
  decomposition.SetConcavity(std::numeric_limits<double>::max());  // the number of parts alone decides when to stop
  decomposition.SetVolumeWeight(0.0);
  // Without these further points it sees hollows at corners only, and joins what lies across them.
  decomposition.SetAddExtraDistPoints(true);
  decomposition.SetAddNeighboursDistPoints(true);
  decomposition.SetAddFacesPoints(true);
  decomposition.SetNVerticesPerCH(static_cast<std::size_t>(params.corners));
  decomposition.Compute();
  std::vector<Mesh> parts;
  for (std::size_t k = 0; k < decomposition.GetNClusters(); ++k) {
    std::vector<Point> corners(decomposition.GetNPointsCH(k));
    std::vector<Indices> faces(decomposition.GetNTrianglesCH(k));
    decomposition.GetCH(k, corners.data(), faces.data());
    const Mesh part = hull_of(corners);
    if (!part.triangles.empty()) {
      parts.push_back(repaired(part));
    }
  }
  return parts;
}

}  // namespace talus
