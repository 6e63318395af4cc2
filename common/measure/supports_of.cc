#include "common/measure/supports_of.h"

#include <algorithm>

#include "common/shape/convex_distance.h"

namespace talus {
namespace {

constexpr double lowered_by = 1e-4;  // in lengths of the body
/// Cosine between the vertical and the steepest normal that still carries: 84 degrees.
constexpr double least_rise = 0.1;

/// Whether a piece of the one touches a piece of the other, and comes nearer once lowered.
template <int Dim>
bool rests_on(const std::vector<ConvexPiece<Dim>>& upper, const std::vector<ConvexPiece<Dim>>& lower, double extent) {
  const double reach = touching_distance * extent;
  Pose<Dim> sunk{Vec<Dim>(-lowered_by * extent * Vec<Dim>::Unit(Dim - 1)), Rotation<Dim>::Identity()};
  for (const ConvexPiece<Dim>& a : upper)
    for (const ConvexPiece<Dim>& b : lower) {
      const double distance = signed_distance(a, b, reach);
      if (distance >= reach) continue;
      if (distance - signed_distance(moved(a, sunk), b, 2.0 * reach) > least_rise * lowered_by * extent) return true;
    }
  return false;
}

}  // namespace

template <int Dim>
std::vector<BodyIndex> supports_of(const World<Dim>& world, const FixedSupports& fixed, BodyIndex body) {
  const BodyStates<Dim>& states = world.states();
  const double extent = world.shape_of(body).extent;
  const Vec<Dim> margin = Vec<Dim>::Constant(touching_distance * extent);
  const Box<Dim> bounds = world.bounds_of(body);
  const Box<Dim> place(bounds.min() - margin, bounds.max() + margin);
  const std::vector<ConvexPiece<Dim>> own = convex_pieces_at(world.shape_of(body), states.pose[body]);
  const Vec<Dim>& at = states.pose[body].position;
  std::vector<BodyIndex> near;
  world.query_box(place, near);
  std::vector<BodyIndex> supports;
  for (const BodyIndex other : near)
    if (other != body && rests_on(own, convex_pieces_at(world.shape_of(other), world.pose_near(other, at)), extent))
      supports.push_back(other);
  for (int k = 0; k < fixed.obstacles; ++k)
    if (world.has_obstacle(k) && bounds_at(world.obstacle_shape(k), world.obstacle_pose(k)).intersects(place) &&
        rests_on(own, convex_pieces_at(world.obstacle_shape(k), world.obstacle_pose(k)), extent))
      supports.push_back(first_obstacle - k);
  if (fixed.ground && height<Dim>(place.min()) < fixed.ground_height) supports.push_back(ground_index);
  std::ranges::sort(supports);
  return supports;
}

template std::vector<BodyIndex> supports_of(const World<2>&, const FixedSupports&, BodyIndex);
template std::vector<BodyIndex> supports_of(const World<3>&, const FixedSupports&, BodyIndex);

}  // namespace talus
