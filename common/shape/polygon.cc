#include "common/shape/polygon.h"

#include <fmt/format.h>

#include "common/math/require.h"

namespace talus {

double cross(const Vec2& origin, const Vec2& a, const Vec2& b) {
  return (a.x() - origin.x()) * (b.y() - origin.y()) - (a.y() - origin.y()) * (b.x() - origin.x());
}

double signed_area(std::span<const Vec2> corners) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) twice += cross(corners[0], corners[i], corners[i + 1]);
  return twice / 2.0;
}

double distance_from_line(const Vec2& point, const Vec2& from, const Vec2& to) {
  const Vec2 along = (to - from).normalized();
  return along.x() * (point.y() - from.y()) - along.y() * (point.x() - from.x());
}

// Every corner must lie to the left of every edge that it does not belong to.
std::optional<std::size_t> non_convex_corner(std::span<const Vec2> corners) {
  Box<2> bounds;
  for (const Vec2& corner : corners) bounds.extend(corner);
  const double least = flatness * bounds.diagonal().norm();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    for (std::size_t other = 0; other < corners.size(); ++other) {
      const bool on_edge = other == i || other == next;
      if (!on_edge && !(distance_from_line(corners[other], corners[i], corners[next]) > least)) return other;
    }
  }
  return std::nullopt;
}

std::string text(const Vec2& corner) { return fmt::format("({}, {})", corner.x(), corner.y()); }

Vec2 outward_normal(std::span<const Vec2> corners, std::size_t from) {
  const Vec2 along = corners[(from + 1) % corners.size()] - corners[from];
  return Vec2(along.y(), -along.x()).normalized();
}

namespace {

// Whether the closed segments a-b and c-d have a point in common.
bool touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Box<2> first = Box<2>(a.cwiseMin(b), a.cwiseMax(b));
  if (!first.intersects(Box<2>(c.cwiseMin(d), c.cwiseMax(d)))) return false;
  const auto side = [](double value) { return (value > 0.0) - (value < 0.0); };
  return side(cross(a, b, c)) * side(cross(a, b, d)) <= 0 && side(cross(c, d, a)) * side(cross(c, d, b)) <= 0;
}

}  // namespace

void check_simple_polygon(std::span<const Vec2> corners) {
  const std::size_t count = corners.size();
  require(count >= 3, "polygon corners.size", static_cast<double>(count), "must be at least 3");
  const auto at = [&](std::size_t i) -> const Vec2& { return corners[i % count]; };
  for (std::size_t i = 0; i < count; ++i) {
    const std::string field = fmt::format("polygon corners[{}]", i);
    require(at(i).allFinite(), field, text(at(i)), "must be finite");
    require(at(i) != at(i + 1), field, text(at(i)), "must differ from the next; the last is joined to the first");
    const Vec2 back = at(i) - at(i + 1);
    const Vec2 on = at(i + 2) - at(i + 1);
    const bool turns_back = cross(at(i + 1), at(i), at(i + 2)) == 0.0 && back.dot(on) > 0.0;
    require(!turns_back, fmt::format("polygon corners[{}]", (i + 1) % count), text(at(i + 1)),
            "must not be a tip without width");
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 2; j < count && j + 1 < count + i; ++j) {
      require(!touch(at(i), at(i + 1), at(j), at(j + 1)), fmt::format("polygon edge after corners[{}]", j), text(at(j)),
              fmt::format("must not touch the edge after corners[{}]", i));
    }
  }
}

}  // namespace talus
