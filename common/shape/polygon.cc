#include "common/shape/polygon.h"

#include <fmt/format.h>

namespace talus {

double cross(const Vec2& origin, const Vec2& a, const Vec2& b) {
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

double signed_area(std::span<const Vec2> corners) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice += cross(corners[0], corners[i], corners[i + 1]);
  }
  return twice / 2.0;
}

double distance_from_line(const Vec2& point, const Vec2& from, const Vec2& to) {
  const Vec2 along = (to - from).normalized();
  return along.x() * (point.y() - from.y()) - along.y() * (point.x() - from.x());
}

// Every corner must lie to the left of every edge that it does not belong to.
std::optional<std::size_t> non_convex_corner(std::span<const Vec2> corners) {
  Box<2> bounds;
  for (const Vec2& corner : corners) {
    bounds.extend(corner);
  }
  const double least = flatness * bounds.diagonal().norm();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    for (std::size_t other = 0; other < corners.size(); ++other) {
      const bool on_edge = other == i || other == next;
      if (!on_edge && !(distance_from_line(corners[other], corners[i], corners[next]) > least)) {
        return other;
      }
    }
  }
  return std::nullopt;
}

std::string text(const Vec2& corner) { return fmt::format("({}, {})", corner.x(), corner.y()); }

Vec2 outward_normal(std::span<const Vec2> corners, std::size_t from) {
  const Vec2 along = corners[(from + 1) % corners.size()] - corners[from];
  return Vec2(along.y(), -along.x()).normalized();
}

}  // namespace talus
