#include "common/scene/spout_rate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shape/shape.h"

namespace talus {
namespace {

// Steps of dt until something of constant acceleration has gone `distance` [m]: the positive root n of
// speed dt n + acceleration dt^2 n (n + 1) / 2 = distance, rounded up. A negative speed first leads the other way.
double steps_to_go(double distance, double speed, double acceleration, double dt) {
  const double quadratic = 0.5 * acceleration * dt * dt;
  const double linear = speed * dt + quadratic;
  const double denominator = linear + std::sqrt(linear * linear + 4.0 * quadratic * distance);
  if (denominator <= 0.0) return std::numeric_limits<double>::infinity();
  // The smallest share of a step off, or rounding turns a whole number into the next.
  return std::ceil(2.0 * distance / denominator - 1e-9);
}

}  // namespace

template <int Dim>
double largest_radius(const Source<Dim>& source, const WorldDescription<Dim>& world) {
  double radius = 0.0;
  for (const int shape : source.shapes) radius = std::max(radius, bounding_radius(world.shapes[shape]));
  return radius;
}

template <int Dim>
Box<Dim> largest_bounds(const Source<Dim>& source, const WorldDescription<Dim>& world) {
  Box<Dim> bounds;
  for (const int shape : source.shapes) {
    const Vec<Dim> reach = Vec<Dim>::Constant(bounding_radius(world.shapes[shape]));
    if (source.orientation)
      bounds.extend(bounds_at(world.shapes[shape], Pose<Dim>{Vec<Dim>::Zero(), *source.orientation}));
    else
      bounds.extend(Box<Dim>(-reach, reach));
  }
  return bounds;
}

template <int Dim>
Vec<Dim> default_spread(const Source<Dim>& source, const WorldDescription<Dim>& world) {
  Vec<Dim> spread = Vec<Dim>::Zero();
  for (int axis = 0; axis < Dim - 1; ++axis)
    spread[axis] = source.grid[axis] == 1 ? largest_radius(source, world) : 0.0;
  return spread;
}

template <int Dim>
double clearing_time(const Source<Dim>& source, const WorldDescription<Dim>& world) {
  constexpr int up = Dim - 1;
  const Vec<Dim> distance =
      2.0 * (Vec<Dim>::Constant(largest_radius(source, world)) + source.spread) + source.grid_extent();
  Vec<Dim> follow = source.velocity_spread;
  if (source.sweep_period > 0.0) follow += 4.0 / source.sweep_period * source.sweep.cwiseAbs();
  double steps = steps_to_go(distance[up], -source.velocity[up] - follow[up], world.gravity, world.dt);
  for (int axis = 0; axis < up; ++axis) {
    const double away = std::abs(source.velocity[axis]) - follow[axis];
    steps = std::min(steps, steps_to_go(distance[axis], std::max(away, 0.0), 0.0, world.dt));
  }
  return steps * world.dt;
}

template <int Dim>
double reachable_rate(const Source<Dim>& source, const WorldDescription<Dim>& world) {
  if (source.count <= source.bodies_at_once()) return source.rate;  // nothing comes after the first
  return std::min(source.rate, source.bodies_at_once() / clearing_time(source, world));
}

template Vec2 default_spread(const Source<2>&, const WorldDescription<2>&);
template Vec3 default_spread(const Source<3>&, const WorldDescription<3>&);
template double clearing_time(const Source<2>&, const WorldDescription<2>&);
template double clearing_time(const Source<3>&, const WorldDescription<3>&);
template double reachable_rate(const Source<2>&, const WorldDescription<2>&);
template double reachable_rate(const Source<3>&, const WorldDescription<3>&);
template Box<2> largest_bounds(const Source<2>&, const WorldDescription<2>&);
template Box<3> largest_bounds(const Source<3>&, const WorldDescription<3>&);
template double largest_radius(const Source<2>&, const WorldDescription<2>&);
template double largest_radius(const Source<3>&, const WorldDescription<3>&);

}  // namespace talus
