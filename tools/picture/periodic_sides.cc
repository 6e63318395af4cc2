#include "tools/picture/periodic_sides.h"

#include <algorithm>

namespace talus {
namespace {

/// From what fills `bounds` to those of its images that are seen between the sides.
template <int Dim>
std::vector<Vec<Dim>> shifts_inside(const Periodic<Dim>& sides, const Box<Dim>& bounds) {
  std::vector<Vec<Dim>> inside;
  for (const Vec<Dim>& shift : sides.shifts(-1)) {
    bool seen = !shift.isZero(0.0);
    for (int axis = 0; axis < Dim; ++axis) {
      if (sides.period[axis] == 0.0) continue;
      const double low = bounds.min()[axis] + shift[axis] - sides.low[axis];
      const double high = bounds.max()[axis] + shift[axis] - sides.low[axis];
      seen = seen && low < sides.period[axis] && high > 0.0;
    }
    if (seen) inside.push_back(shift);
  }
  return inside;
}

}  // namespace

template <int Dim>
PictureInput<Dim> with_images(const PictureInput<Dim>& input) {
  PictureInput<Dim> all = input;
  if (!input.sides.any()) return all;
  for (BodyIndex body = 0; body < input.states.size(); ++body) {
    if (input.states.removed[body] != 0) continue;
    const Pose<Dim>& pose = input.states.pose[body];
    const int shape = input.states.shape[body];
    for (const Vec<Dim>& shift : shifts_inside(input.sides, bounds_at(input.shapes[shape], pose))) {
      all.states.shape.push_back(shape);
      all.states.pose.push_back({pose.position + shift, pose.rotation});
      all.states.asleep.push_back(input.states.asleep[body]);
      all.states.removed.push_back(0);
    }
  }
  for (const Obstacle<Dim>& obstacle : input.obstacles) {
    for (const Vec<Dim>& shift : shifts_inside(input.sides, bounds_at(obstacle.shape, obstacle.pose))) {
      Obstacle<Dim>& image = all.obstacles.emplace_back(obstacle);
      image.pose.position += shift;
    }
  }
  return all;
}

template <int Dim>
Box<Dim> between_sides(const Periodic<Dim>& sides, Box<Dim> box) {
  for (int axis = 0; axis < Dim; ++axis) {
    if (sides.period[axis] == 0.0) continue;
    box.min()[axis] = std::min(box.min()[axis], sides.low[axis]);
    box.max()[axis] = std::max(box.max()[axis], sides.low[axis] + sides.period[axis]);
  }
  return box;
}

template <int Dim>
std::vector<std::vector<Vec<Dim>>> outlines_of(const Periodic<Dim>& sides, const Box<Dim>& box) {
  Box<Dim> within = box;
  for (int axis = 0; axis < Dim; ++axis) {
    if (sides.period[axis] == 0.0) continue;
    within.min()[axis] = sides.low[axis];
    within.max()[axis] = sides.low[axis] + sides.period[axis];
  }
  std::vector<std::vector<Vec<Dim>>> outlines;
  for (int axis = 0; axis < Dim; ++axis) {
    if (sides.period[axis] == 0.0) continue;
    for (const double place : {within.min()[axis], within.max()[axis]}) {
      std::vector<Vec<Dim>> corners = {within.min(), within.min(), within.max(), within.max(), within.min()};
      corners[1][Dim - 1] = within.max()[Dim - 1];
      corners[3][Dim - 1] = within.min()[Dim - 1];
      if constexpr (Dim == 2) corners.resize(2);
      for (Vec<Dim>& corner : corners) corner[axis] = place;
      outlines.push_back(corners);
    }
  }
  return outlines;
}

template PictureInput<2> with_images(const PictureInput<2>&);
template PictureInput<3> with_images(const PictureInput<3>&);
template Box<2> between_sides(const Periodic<2>&, Box<2>);
template Box<3> between_sides(const Periodic<3>&, Box<3>);
template std::vector<std::vector<Vec2>> outlines_of(const Periodic<2>&, const Box<2>&);
template std::vector<std::vector<Vec3>> outlines_of(const Periodic<3>&, const Box<3>&);

}  // namespace talus
