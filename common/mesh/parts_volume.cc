#include "common/mesh/parts_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace talus {
namespace {

struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// The half spaces whose intersection a convex part is: normal . x <= offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

struct Part {
  std::vector<HalfSpace> half_spaces;
  Box<3> bounds;
};

Part half_spaces_of(const Mesh& mesh) {
  Part part{.half_spaces = {}, .bounds = bounds_of(mesh)};
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.corners[triangle[k]]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    part.half_spaces.push_back({normal, normal.dot(corner(0))});
  }
  return part;
}

// Where the line parallel to z through (x, y) lies in the part; `high` below `low` where it misses the part.
Interval inside(const Part& part, double x, double y) {
  if (x < part.bounds.min().x() || x > part.bounds.max().x() || y < part.bounds.min().y() || y > part.bounds.max().y())
    return {0.0, -1.0};
  Interval interval{part.bounds.min().z(), part.bounds.max().z()};
  for (const HalfSpace& half : part.half_spaces) {
    const double rest = half.offset - half.normal.x() * x - half.normal.y() * y;
    if (half.normal.z() > 0.0)
      interval.high = std::min(interval.high, rest / half.normal.z());
    else if (half.normal.z() < 0.0)
      interval.low = std::max(interval.low, rest / half.normal.z());
    else if (rest < 0.0)
      return {0.0, -1.0};
  }
  return interval;
}

double length_of_union(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  double length = 0.0;
  double covered_to = -std::numeric_limits<double>::infinity();
  for (const Interval& interval : intervals) {
    length += std::max(0.0, interval.high - std::max(interval.low, covered_to));
    covered_to = std::max(covered_to, interval.high);
  }
  return length;
}

}  // namespace

double union_volume(std::span<const Mesh> parts) {
  constexpr int lines = 16384;
  std::vector<Part> all;
  Box<3> bounds;
  for (const Mesh& mesh : parts) {
    all.push_back(half_spaces_of(mesh));
    bounds.extend(all.back().bounds);
  }
  if (all.empty()) return 0.0;
  // Places that fill a square evenly without being in rows, which may fall beside edges (the R2 sequence of M.
  // Roberts).
  const Vec2 share_of = {0.7548776662466927, 0.5698402909980532};
  const Vec3 size = bounds.sizes();
  double length = 0.0;
  std::vector<Interval> intervals;
  for (int i = 0; i < lines; ++i) {
    const double x = bounds.min().x() + size.x() * std::fmod((i + 0.5) * share_of.x(), 1.0);
    const double y = bounds.min().y() + size.y() * std::fmod((i + 0.5) * share_of.y(), 1.0);
    intervals.clear();
    for (const Part& part : all) {
      const Interval interval = inside(part, x, y);
      if (interval.high > interval.low) intervals.push_back(interval);
    }
    length += length_of_union(intervals);
  }
  return length / lines * size.x() * size.y();
}

double volume_ratio(std::span<const Mesh> parts, const Mesh& mesh) {
  return union_volume(parts) / moments(mesh).volume;
}

bool fills_mesh(double ratio, double tolerance) { return std::abs(ratio - 1.0) <= tolerance; }

}  // namespace talus
