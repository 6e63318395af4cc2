#include "common/scene/convex_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/math/require.h"
#include "common/shape/catalogue.h"

namespace talus {
namespace {

// Unit normal of the side that begins at a corner, outwards.
Vec2 outwards(std::span<const Vec2> outline, std::size_t from) {
  const Vec2 along = outline[(from + 1) % outline.size()] - outline[from];
  return Vec2(along.y(), -along.x()).normalized();
}

// The outline of the walls' outer faces, corner by corner. Throws std::invalid_argument for a sharp corner.
std::vector<Vec2> widened(std::span<const Vec2> outline, double by) {
  constexpr double sharpest = 5.0;  // [degrees]; the outer corner then lies 23 times the walls' thickness away
  std::vector<Vec2> wide;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 before = outwards(outline, (i + outline.size() - 1) % outline.size());
    const Vec2 after = outwards(outline, i);
    const double angle = std::acos(std::clamp(-before.dot(after), -1.0, 1.0)) * 180.0 / std::numbers::pi;
    require(angle >= sharpest, "corners", angle,
            fmt::format("must meet at {} degrees or more, here {:.3g}: walls around a sharper corner have no end",
                        sharpest, angle));
    wide.emplace_back(outline[i] + by * (before + after) / (1.0 + before.dot(after)));
  }
  return wide;
}

Obstacle<3> prism(std::span<const Vec2> base, double from, double to, const Pose<3>& pose, const Material& material) {
  std::vector<Vec3> corners;
  for (const Vec2& corner : base) {
    corners.emplace_back(corner.x(), corner.y(), from);
    corners.emplace_back(corner.x(), corner.y(), to);
  }
  const Shape<3> shape = make_shape<3>("wall", hull_pieces<3>(corners), material);
  return {shape, {pose * Vec3(-shape.reference), pose.rotation}};
}

}  // namespace

std::vector<Obstacle<3>> convex_container_walls(const ConvexContainerParams& params, const Pose<3>& pose,
                                                const Material& material) {
  const std::vector<Vec2> wide = widened(params.outline, params.wall);
  std::vector<Obstacle<3>> walls;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    const std::size_t next = (i + 1) % wide.size();
    walls.push_back(prism(std::vector<Vec2>{params.outline[i], wide[i], wide[next], params.outline[next]}, 0.0,
                          params.height, pose, material));
  }
  if (params.floor) {
    walls.push_back(prism(wide, -params.wall, 0.0, pose, material));
  }
  return walls;
}

std::vector<Vec2> round_outline(double radius) {
  constexpr int sides = 32;
  const double turn = 2.0 * std::numbers::pi / sides;
  std::vector<Vec2> outline;
  for (int i = 0; i < sides; ++i) {
    outline.emplace_back(radius / std::cos(turn / 2.0) * Vec2(std::cos(i * turn), std::sin(i * turn)));
  }
  return outline;
}

Boundary<3> convex_boundary(std::span<const Vec2> outline, double rim) {
  Boundary<3> boundary{.rim = rim};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 normal = outwards(outline, i);
    const double distance = normal.dot(outline[i]);
    require(distance > 0.0, "boundary.corners", distance,
            "must lie around at: each side's distance from it must be above 0 m");
    boundary.walls.push_back({normal, distance});
  }
  return boundary;
}

}  // namespace talus
