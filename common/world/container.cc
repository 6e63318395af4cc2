#include "common/world/container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/math/angle.h"
#include "common/math/require.h"
#include "common/shape/catalogue.h"
#include "common/shape/polygon.h"

namespace talus {
namespace {

/// The outline of the walls' outer faces, corner by corner. Throws InvalidValue for a sharp corner.
std::vector<Vec2> widened(std::span<const Vec2> outline, double by) {
  constexpr double sharpest = 5.0;  // [degrees]; the outer corner then lies 23 times the walls' thickness away
  std::vector<Vec2> wide;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 before = outward_normal(outline, (i + outline.size() - 1) % outline.size());
    const Vec2 after = outward_normal(outline, i);
    const double angle = in_degrees(std::acos(std::clamp(-before.dot(after), -1.0, 1.0)));
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

template <int Dim>
std::vector<Obstacle<Dim>> container_walls(const ContainerParams<Dim>& params, const Pose<Dim>& pose,
                                           const Material& material) {
  std::vector<Obstacle<Dim>> walls;
  const auto add = [&](const Vec<Dim>& size, const Vec<Dim>& middle) {
    walls.push_back({make_shape<Dim>("wall", box_pieces<Dim>(size), material), {pose * middle, pose.rotation}});
  };
  constexpr int up = Dim - 1;
  const Vec<Dim>& inner = params.inner_size;
  for (int axis = 0; axis < up; ++axis) {
    Vec<Dim> size = inner;
    size[axis] = params.wall;
    if (axis > 0) size[0] += 2.0 * params.wall;  // the later walls reach over the corners
    Vec<Dim> middle = Vec<Dim>::Unit(axis) * (inner[axis] + params.wall) / 2.0;
    middle[up] = inner[up] / 2.0;
    add(size, middle);
    middle[axis] = -middle[axis];
    add(size, middle);
  }
  if (params.floor) {
    Vec<Dim> size = inner + Vec<Dim>::Constant(2.0 * params.wall);
    size[up] = params.wall;
    add(size, Vec<Dim>::Unit(up) * (-params.wall / 2.0));
  }
  return walls;
}

std::vector<Obstacle<3>> convex_container_walls(const ConvexContainerParams& params, const Pose<3>& pose,
                                                const Material& material) {
  const std::vector<Vec2> wide = widened(params.outline, params.wall);
  std::vector<Obstacle<3>> walls;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    const std::size_t next = (i + 1) % wide.size();
    walls.push_back(prism(std::vector<Vec2>{params.outline[i], wide[i], wide[next], params.outline[next]}, 0.0,
                          params.height, pose, material));
  }
  if (params.floor) walls.push_back(prism(wide, -params.wall, 0.0, pose, material));
  return walls;
}

std::vector<Vec2> round_outline(double radius) {
  constexpr int sides = 32;
  const double turn = 2.0 * std::numbers::pi / sides;
  std::vector<Vec2> outline;
  for (int i = 0; i < sides; ++i)
    outline.emplace_back(radius / std::cos(turn / 2.0) * Vec2(std::cos(i * turn), std::sin(i * turn)));
  return outline;
}

template std::vector<Obstacle<2>> container_walls(const ContainerParams<2>&, const Pose<2>&, const Material&);
template std::vector<Obstacle<3>> container_walls(const ContainerParams<3>&, const Pose<3>&, const Material&);

}  // namespace talus
