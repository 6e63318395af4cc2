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
    const Vec3& corner = mesh.corners[index];
    path.emplace_back(std::llround(corner.x() * ticks), std::llround(corner.z() * ticks));
  }
  if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
  return path;
}

// The union of all triangles; those facing away are turned, so that they add to the others instead of taking away.
ClipperLib::Path largest_region(const Mesh& mesh, double ticks) {
  ClipperLib::Clipper clipper;
  for (const auto& triangle : mesh.triangles)
    clipper.AddPath(projected(mesh, triangle, ticks), ClipperLib::ptSubject, true);
  ClipperLib::Paths regions;
  clipper.Execute(ClipperLib::ctUnion, regions, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  const auto largest = std::max_element(regions.begin(), regions.end(), [](const auto& a, const auto& b) {
    return ClipperLib::Area(a) < ClipperLib::Area(b);
  });
  return largest == regions.end() ? ClipperLib::Path() : *largest;
}

double distance_from_segment(const Vec2& point, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double share = along.squaredNorm() > 0.0 ? (point - from).dot(along) / along.squaredNorm() : 0.0;
  return (from + std::clamp(share, 0.0, 1.0) * along - point).norm();
}

// Douglas and Peucker: between two corners that stay, the one furthest off the line stays too, if it is far enough.
void keep_far_corners(const std::vector<Vec2>& line, std::size_t first, std::size_t last, double detail,
                      std::vector<Vec2>& kept) {
  std::size_t furthest = first;
  double distance = detail;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double here = distance_from_segment(line[i], line[first], line[last]);
    if (here > distance) {
      furthest = i;
      distance = here;
    }
  }
  if (furthest != first) {
    keep_far_corners(line, first, furthest, detail, kept);
    kept.push_back(line[furthest]);
    keep_far_corners(line, furthest, last, detail, kept);
  }
}

// The leftmost corner is a tip of the outline and stays in any case.
std::vector<Vec2> simplified(std::vector<Vec2> loop, double detail) {
  const auto by_x = [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_x), loop.end());
  loop.push_back(loop.front());
  std::vector<Vec2> kept = {loop.front()};
  keep_far_corners(loop, 0, loop.size() - 1, detail, kept);
  return kept;
}

}  // namespace

std::vector<Vec2> silhouette(const Mesh& mesh, double detail) {
  const double ticks = ticks_per_length / bounds_of(mesh).diagonal().norm();
  require(std::isfinite(detail) && detail > 0.0, "silhouette.detail", detail, "must be finite and above 0 m");
  std::vector<Vec2> outline;
  for (const ClipperLib::IntPoint& point : largest_region(mesh, ticks))
    outline.emplace_back(static_cast<double>(point.X) / ticks, static_cast<double>(point.Y) / ticks);
  require(!outline.empty(), "silhouette of mesh", 0.0, "must have an area");
  std::vector<Vec2> corners = simplified(std::move(outline), detail);
  require(corners.size() >= 3, "silhouette.detail", detail, "must be finer: it leaves no area of the mesh");
  return corners;
}

}  // namespace talus
