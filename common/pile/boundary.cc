#include "common/pile/boundary.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "common/math/require.h"
#include "common/shape/polygon.h"

namespace talus {
namespace {

constexpr double far_away = 1e6;  // [m], beyond any scene: a container that reaches so far is not closed

/// Keeps the part of a convex polygon (counter-clockwise) behind a wall.
std::vector<Vec2> clip(const std::vector<Vec2>& corners, const Wall<3>& wall) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    const double beyond_a = wall.normal.dot(a) - wall.distance;
    const double beyond_b = wall.normal.dot(b) - wall.distance;
    if (beyond_a <= 0.0) kept.push_back(a);
    if ((beyond_a < 0.0) != (beyond_b < 0.0) && beyond_a != beyond_b)
      kept.push_back(a + (b - a) * (beyond_a / (beyond_a - beyond_b)));
  }
  return kept;
}

double area_within(const std::vector<Wall<3>>& walls) {
  std::vector<Vec2> corners = {
      {-far_away, -far_away}, {far_away, -far_away}, {far_away, far_away}, {-far_away, far_away}};
  for (const Wall<3>& wall : walls) corners = clip(corners, wall);
  double doubled = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    if (a.cwiseAbs().maxCoeff() >= far_away)
      throw std::invalid_argument("pile.boundary: its walls must close all around");
    doubled += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * doubled;
}

double area_within(const std::vector<Wall<2>>& walls) {
  double left = far_away;
  double right = far_away;
  for (const Wall<2>& wall : walls) {
    double& side = wall.normal.x() > 0.0 ? right : left;
    side = std::min(side, wall.distance);
  }
  if (left + right >= far_away) throw std::invalid_argument("pile.boundary: needs a wall on both sides");
  return left + right;
}

}  // namespace

template <int Dim>
double Boundary<Dim>::gauge(const Horizontal<Dim>& from_centre) const {
  if (cylinder_radius > 0.0) return from_centre.norm() / cylinder_radius;
  double largest = 0.0;
  for (const Wall<Dim>& wall : walls) largest = std::max(largest, wall.normal.dot(from_centre) / wall.distance);
  return largest;
}

template <int Dim>
double Boundary<Dim>::inner_radius() const {
  if (cylinder_radius > 0.0) return cylinder_radius;
  double nearest = far_away;
  for (const Wall<Dim>& wall : walls) nearest = std::min(nearest, wall.distance);
  return nearest;
}

template <int Dim>
double Boundary<Dim>::area() const {
  if (cylinder_radius > 0.0) return std::numbers::pi * cylinder_radius * cylinder_radius;
  return area_within(walls);
}

template <int Dim>
Boundary<Dim> box_boundary(const Horizontal<Dim>& size, double rim) {
  Boundary<Dim> boundary{.rim = rim};
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const Horizontal<Dim> outwards = Horizontal<Dim>::Unit(axis);
    boundary.walls.push_back({outwards, 0.5 * size[axis]});
    boundary.walls.push_back({-outwards, 0.5 * size[axis]});
  }
  return boundary;
}

Boundary<3> convex_boundary(std::span<const Vec2> outline, double rim) {
  Boundary<3> boundary{.rim = rim};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 normal = outward_normal(outline, i);
    const double distance = normal.dot(outline[i]);
    require(distance > 0.0, "boundary.corners", distance,
            "must lie around at: each side's distance from it must be above 0 m");
    boundary.walls.push_back({normal, distance});
  }
  return boundary;
}

template struct Boundary<2>;
template struct Boundary<3>;
template Boundary<2> box_boundary(const Horizontal<2>&, double);
template Boundary<3> box_boundary(const Horizontal<3>&, double);

}  // namespace talus
