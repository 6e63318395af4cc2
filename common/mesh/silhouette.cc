#include "common/mesh/silhouette.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "common/math/require.h"

namespace talus {
namespace {

constexpr double ticks_per_length = 1 << 24;  // Clipper computes in whole numbers: exact, and finer than files are

ClipperLib::Path projected(const Mesh& mesh, const std::array<int, 3>& triangle, double ticks) {
  ClipperLib::Path path;
  for (const int index : triangle) {
    const Vec3& corner = mesh.corners[static_cast<std::size_t>(index)];
    path.emplace_back(std::llround(corner.x() * ticks), std::llround(corner.z() * ticks));
  }
  if (!ClipperLib::Orientation(path)) {
    ClipperLib::ReversePath(path);
  }
  return path;
}

// The union of all triangles; those facing away are turned, so that they add to the others instead of taking away.
ClipperLib::Path largest_region(const Mesh& mesh, double ticks) {
  ClipperLib::Clipper clipper;
  for (const auto& triangle : mesh.triangles) {
    clipper.AddPath(projected(mesh, triangle, ticks), ClipperLib::ptSubject, true);
  }
  ClipperLib::Paths regions;
  clipper.Execute(ClipperLib::ctUnion, regions, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  const auto largest = std::max_element(regions.begin(), regions.end(), [](const auto& a, const auto& b) {
    return ClipperLib::Area(a) < ClipperLib::Area(b);
  });
  return largest == regions.end() ? ClipperLib::Path() : *largest;
}

}  // namespace

std::vector<Vec2> silhouette(const Mesh& mesh, double detail) {
  Box<3> bounds;
  for (const Vec3& corner : mesh.corners) {
    bounds.extend(corner);
  }
  const double ticks = ticks_per_length / bounds.diagonal().norm();
  require(std::isfinite(detail) && detail > 0.0, "silhouette.detail", detail, "must be finite and above 0 m");
  ClipperLib::Path outline = largest_region(mesh, ticks);
  ClipperLib::CleanPolygon(outline, detail * ticks);
  require(outline.size() >= 3, "silhouette.detail", detail, "must be finer: it leaves no area of the mesh");
  std::vector<Vec2> corners;
  for (const ClipperLib::IntPoint& point : outline) {
    corners.emplace_back(static_cast<double>(point.X) / ticks, static_cast<double>(point.Y) / ticks);
  }
  return corners;
}

}  // namespace talus
