#include "common/shape/surface.h"

#include <numbers>

#include "common/math/require.h"
#include "common/shape/convex_hull.h"

namespace talus {
namespace {

using std::numbers::pi;

void check_segments(int segments) {
  require(segments >= 4 && segments % 4 == 0, "segments", segments, "must be a multiple of 4, at least 4");
}

// Adds the corners of an arc, both ends included.
void add_arc(Loop<2>& loop, const Vec2& centre, double radius, double from, double to, int segments) {
  for (int i = 0; i <= segments; ++i) {
    const double angle = from + (to - from) * i / segments;
    loop.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
}

Loop<2> outline(const HullPiece<2>& hull, int segments) {
  if (!hull.round()) return hull.corners;
  Loop<2> loop;
  const Vec2& a = hull.corners.front();
  const Vec2& b = hull.corners.back();
  if (hull.corners.size() == 1) {
    add_arc(loop, a, hull.radius, 0.0, 2.0 * pi * (segments - 1) / segments, segments - 1);
  } else {
    const double angle = std::atan2((b - a).y(), (b - a).x());
    add_arc(loop, b, hull.radius, angle - pi / 2.0, angle + pi / 2.0, segments / 2);
    add_arc(loop, a, hull.radius, angle + pi / 2.0, angle + 1.5 * pi, segments / 2);
  }
  return loop;
}

void add_faces(std::vector<Loop<3>>& faces, const BoxPiece<3>& box, int) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 out = side * box.half[axis] * Vec3::Unit(axis);
      const Vec3 right = box.half[(axis + 1) % 3] * Vec3::Unit((axis + 1) % 3);
      const Vec3 up = side * box.half[(axis + 2) % 3] * Vec3::Unit((axis + 2) % 3);
      faces.push_back({box.pose * (out - right - up), box.pose * (out + right - up), box.pose * (out + right + up),
                       box.pose * (out - right + up)});
    }
  }
}

// A ring of latitude around the segment from a to b; the poles are rings of a single corner.
struct Latitude {
  Vec3 middle;
  double radius;
};

// From the pole beyond a to the pole beyond b. Both equators are there when a and b differ.
std::vector<Latitude> latitudes(const Vec3& a, const Vec3& b, const Vec3& axis, double radius, int segments) {
  std::vector<Latitude> rings;
  const int steps = segments / 2;
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi * i / steps - pi / 2.0;
    const bool lower = 2 * i <= steps;
    const double around = i == 0 || i == steps ? 0.0 : radius * std::cos(angle);
    rings.push_back({(lower ? a : b) + radius * std::sin(angle) * axis, around});
    if (2 * i == steps && a != b) rings.push_back({b, radius});
  }
  return rings;
}

// The faces between neighbouring rings: trapezoids, at the poles triangles.
void add_revolved(std::vector<Loop<3>>& faces, const std::vector<Latitude>& rings, const Vec3& axis, int segments) {
  const Vec3 right = axis.unitOrthogonal();
  const Vec3 up = axis.cross(right);
  const auto corner = [&](const Latitude& ring, int i) -> Vec3 {
    const double angle = 2.0 * pi * (i % segments) / segments;
    return ring.middle + ring.radius * (std::cos(angle) * right + std::sin(angle) * up);
  };
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (int i = 0; i < segments; ++i) {
      Loop<3> loop = {corner(rings[k], i)};
      if (rings[k].radius > 0.0) loop.push_back(corner(rings[k], i + 1));
      loop.push_back(corner(rings[k + 1], i + 1));
      if (rings[k + 1].radius > 0.0) loop.push_back(corner(rings[k + 1], i));
      faces.push_back(std::move(loop));
    }
  }
}

void add_faces(std::vector<Loop<3>>& faces, const HullPiece<3>& hull, int segments) {
  if (hull.round()) {
    const Vec3& a = hull.corners.front();
    const Vec3& b = hull.corners.back();
    const Vec3 axis = hull.corners.size() == 1 ? Vec3::UnitZ() : Vec3((b - a).normalized());
    add_revolved(faces, latitudes(a, b, axis, hull.radius, segments), axis, segments);
    return;
  }
  for (const std::vector<int>& face : convex_hull_faces(hull.corners)) {
    Loop<3>& loop = faces.emplace_back();
    for (const int index : face) loop.push_back(hull.corners[index]);
  }
}

}  // namespace

std::vector<Loop<2>> outlines(const Shape<2>& shape, int segments) {
  check_segments(segments);
  std::vector<Loop<2>> loops;
  for (const Piece<2>& piece : shape.pieces) loops.push_back(outline(as_hull(piece), segments));
  return loops;
}

std::vector<Loop<3>> faces(const Shape<3>& shape, int segments) {
  check_segments(segments);
  std::vector<Loop<3>> all;
  for (const Piece<3>& piece : shape.pieces)
    std::visit([&](const auto& kind) { add_faces(all, kind, segments); }, piece);
  return all;
}

}  // namespace talus
