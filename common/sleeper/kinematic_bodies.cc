#include "common/sleeper/kinematic_bodies.h"

#include "common/policy/near_bodies.h"
#include "common/policy/rest/rest_criterion.h"
#include "common/shape/convex_distance.h"
#include "common/shape/convex_piece.h"

namespace talus {
namespace {

// Largest motion that does not count, in D of the sleeping bodies.
constexpr double rounding = 1e-5;  // in one step
constexpr double creep = 1e-3;     // since the body last counted as moving

/// The box in its own axes around a shape.
template <int Dim>
ConvexPiece<Dim> box_of(const Shape<Dim>& shape, const Pose<Dim>& at) {
  const BoxPiece<Dim> box = {.pose = {.position = shape.bounds.center()}, .half = 0.5 * shape.bounds.sizes()};
  return convex_piece<Dim>(placed<Dim>(box, at));
}

}  // namespace

template <int Dim>
int KinematicBodies<Dim>::add(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  const int number = world_.add_obstacle(shape, pose, true);
  bodies_.resize(world_.obstacles().size());
  bodies_[number] = {.noticed = pose};
  return number;
}

template <int Dim>
void KinematicBodies<Dim>::place(int number, const Pose<Dim>& at) {
  world_.place_obstacle(number, at);
  bodies_[number].noticed = at;
}

template <int Dim>
void KinematicBodies<Dim>::move(int number, const Pose<Dim>& to, const Vec<Dim>& velocity, const Spin<Dim>& spin,
                                double dt, double extent) {
  Body& body = bodies_[number];
  const double reach = bounding_radius(world_.obstacle_shape(number));
  const double went = max_displacement<Dim>(world_.obstacle_pose(number), to, reach);
  const double goes = dt * (velocity.norm() + reach * spin.norm());
  world_.place_obstacle(number, to);
  body.travel = std::max(went, goes);
  body.moved = body.travel > rounding * extent || max_displacement<Dim>(body.noticed, to, reach) > creep * extent;
  if (body.moved) body.noticed = to;
}

template <int Dim>
void KinematicBodies<Dim>::find_sleepers(int number, double margin, std::vector<BodyIndex>& found) const {
  const Body& body = bodies_[number];
  if (!body.moved) return;
  const double reach = margin + body.travel;
  const ConvexPiece<Dim> own = box_of(world_.obstacle_shape(number), world_.obstacle_pose(number));
  for (const BodyIndex near : bodies_near<Dim>(world_, bounds(number), reach)) {
    if (world_.states().asleep[near] == 0) continue;
    const ConvexPiece<Dim> other = box_of(world_.shape_of(near), world_.states().pose[near]);
    if (signed_distance(other, own, reach) < reach) found.push_back(near);
  }
}

template class KinematicBodies<2>;
template class KinematicBodies<3>;

}  // namespace talus
