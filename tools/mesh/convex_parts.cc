#include "tools/mesh/convex_parts.h"

#include <hacdHACD.h>

#include <limits>

#include "common/math/require.h"
#include "common/mesh/mesh_repair.h"
#include "tools/mesh/hull_mesh.h"

namespace talus {
namespace {

using Point = HACD::Vec3<HACD::Real>;
using Indices = HACD::Vec3<long>;

/// The parts that HACD found, as hulls of their corners.
std::vector<Mesh> parts_of(HACD::HACD& decomposition) {
  std::vector<Mesh> parts;
  for (std::size_t k = 0; k < decomposition.GetNClusters(); ++k) {
    std::vector<Point> corners(decomposition.GetNPointsCH(k));
    std::vector<Indices> faces(decomposition.GetNTrianglesCH(k));
    decomposition.GetCH(k, corners.data(), faces.data());
    std::vector<Vec3> places;
    for (const Point& corner : corners) {
      places.emplace_back(corner.X(), corner.Y(), corner.Z());
    }
    const Mesh part = hull_mesh(places);  // HACD's own triangles are not needed
    if (!part.triangles.empty()) {
      parts.push_back(repaired(part));
    }
  }
  return parts;
}

void set_params(HACD::HACD& decomposition, const ConvexPartsParams& params) {
  decomposition.SetNClusters(params.parts);
  decomposition.SetConcavity(std::numeric_limits<double>::max());  // the number of parts alone decides when to stop
  decomposition.SetVolumeWeight(0.0);
  // Without these further points it sees hollows at corners only, and joins what lies across them.
  decomposition.SetAddExtraDistPoints(true);
  decomposition.SetAddNeighboursDistPoints(true);
  decomposition.SetAddFacesPoints(true);
  decomposition.SetNVerticesPerCH(params.corners);
}

}  // namespace

std::vector<Mesh> convex_parts(const Mesh& mesh, const ConvexPartsParams& params) {
  require(params.parts >= 1 && params.parts <= most_parts, "parts", params.parts, "must be in 1..64");
  require(params.corners >= 4 && params.corners <= most_part_corners, "corners", params.corners, "must be in 4..128");
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
  set_params(decomposition, params);
  decomposition.Compute();
  return parts_of(decomposition);
}

}  // namespace talus
