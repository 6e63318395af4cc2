#include "tools/mesh/convex_parts.h"

#include <hacdHACD.h>

#include <algorithm>
#include <limits>

#include "common/math/require.h"
#include "common/mesh/mesh.h"
#include "common/mesh/parts_volume.h"
#include "common/shape/convex_hull.h"

namespace talus {
namespace {

// A point within an edge or a face of the hull belongs to one or two faces; a corner to three or more.
std::vector<Vec3> corners_of_hull(std::span<const Vec3> points) {
  std::vector<int> faces_at(points.size(), 0);
  for (const std::vector<int>& face : convex_hull_faces(points))
    for (const int corner : face) ++faces_at[corner];
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (faces_at[i] >= 3) corners.push_back(points[i]);
  return corners;
}

// How far a point lies outside a hull; of a hull without triangles, its distance from the middle of the corners.
double distance_outside(const Mesh& hull, const Vec3& point) {
  if (hull.triangles.empty()) return std::numeric_limits<double>::max();
  double distance = 0.0;
  for (const auto& triangle : hull.triangles) {
    const auto corner = [&](std::size_t k) { return hull.corners[triangle[k]]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    distance = std::max(distance, normal.dot(point - corner(0)));
  }
  return distance;
}

// The corners farthest along each axis to both sides, each once.
std::vector<Vec3> extreme_corners(const Mesh& hull) {
  std::vector<Vec3> extremes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::minmax_element(hull.corners.begin(), hull.corners.end(), less);
    for (const Vec3& corner : {*low, *high})
      if (std::find(extremes.begin(), extremes.end(), corner) == extremes.end()) extremes.push_back(corner);
  }
  return extremes;
}

}  // namespace

Mesh hull_mesh(std::span<const Vec3> points) {
  Mesh hull{corners_of_hull(points), {}};
  for (const std::vector<int>& face : convex_hull_faces(hull.corners))
    for (std::size_t i = 1; i + 1 < face.size(); ++i) hull.triangles.push_back({face[0], face[i], face[i + 1]});
  return hull;
}

Mesh coarser_hull(const Mesh& hull, int corners) {
  const double volume = moments(hull).volume;
  std::vector<Vec3> chosen = extreme_corners(hull);
  Mesh coarser = hull_mesh(chosen);
  while (std::ssize(chosen) < most_part_corners) {
    const bool enough = std::ssize(chosen) >= corners && !coarser.triangles.empty();
    if (enough && fills_mesh(moments(coarser).volume / volume)) break;
    const auto nearer = [&](const Vec3& a, const Vec3& b) {
      return distance_outside(coarser, a) < distance_outside(coarser, b);
    };
    std::vector<Vec3> rest;
    for (const Vec3& corner : hull.corners)
      if (std::find(chosen.begin(), chosen.end(), corner) == chosen.end()) rest.push_back(corner);
    if (rest.empty()) break;
    chosen.push_back(*std::max_element(rest.begin(), rest.end(), nearer));
    coarser = hull_mesh(chosen);
  }
  return coarser;
}

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
    for (const Point& corner : corners) places.emplace_back(corner.X(), corner.Y(), corner.Z());
    const Mesh part = hull_mesh(places);  // HACD's own triangles are not needed
    if (!part.triangles.empty()) parts.push_back(repaired(part));
  }
  return parts;
}

void set_params(HACD::HACD& decomposition, const ConvexPartsParams& params) {
  decomposition.SetNClusters(params.parts);
  decomposition.SetConcavity(std::numeric_limits<double>::max());  // the number of parts alone decides when to stop
  decomposition.SetVolumeWeight(0.0);
  // Without these further points it finds hollows at corners only, and joins what lies across them.
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
  for (const Vec3& corner : mesh.corners) points.emplace_back(corner.x(), corner.y(), corner.z());
  std::vector<Indices> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) triangles.emplace_back(triangle[0], triangle[1], triangle[2]);
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
