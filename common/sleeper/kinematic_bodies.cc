#include "common/sleeper/kinematic_bodies.h"

#include <algorithm>

#include "common/policy/adaptive/rest_criterion.h"
#include "common/policy/near_bodies.h"
#include "common/shape/convex_distance.h"

namespace talus {
namespace {

// Largest motion that does not count, in D of the sleeping bodies.
constexpr double rounding = 1e-5;  // in one step
constexpr double creep = 1e-3;     // since the body last counted as moving

}  // namespace

template <int Dim>
int KinematicBodies<Dim>::add(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  if (free_.empty()) {
    free_.push_back(static_cast<int>(bodies_.size()));
    bodies_.emplace_back();
  }
  const int number = free_.back();
  free_.pop_back();
  bodies_[number] = {.shape = shape, .pose = pose, .noticed = pose};
  return number;
}

template <int Dim>
Box<Dim> KinematicBodies<Dim>::bounds(int number) const {
  return bounds_at(bodies_[number].shape, bodies_[number].pose);
}

template <int Dim>
void KinematicBodies<Dim>::move(int number, const Pose<Dim>& to, const Vec<Dim>& velocity, const Spin<Dim>& spin,
                                double dt, double extent) {
  Body& body = bodies_[number];
  const double reach = bounding_radius(body.shape);
  const double went = max_displacement<Dim>(body.pose, to, reach);
  const double goes = dt * (velocity.norm() + reach * spin.norm());
  body.pose = to;
  body.travel = std::max(went, goes);
  body.moved = body.travel > rounding * extent || max_displacement<Dim>(body.noticed, to, reach) > creep * extent;
  if (body.moved) body.noticed = to;
}

template <int Dim>
void KinematicBodies<Dim>::find_sleepers(int number, const World<Dim>& world, double margin,
                                         std::vector<BodyIndex>& found) const {
  const Body& body = bodies_[number];
  if (!body.moved) return;
  const double reach = margin + body.travel;
  const std::vector<ConvexPiece<Dim>> pieces = convex_pieces_at(body.shape, body.pose);
  for (const BodyIndex near : bodies_near<Dim>(world, bounds(number), reach)) {
    if (world.states().asleep[near] == 0) continue;
    const ConvexPiece<Dim> box = convex_pieces_at(world.shape_of(near), world.states().pose[near]).front();
    const auto touches = [&](const ConvexPiece<Dim>& piece) { return signed_distance(box, piece, reach) < reach; };
    if (std::ranges::any_of(pieces, touches)) found.push_back(near);
  }
}

template class KinematicBodies<2>;
template class KinematicBodies<3>;

}  // namespace talus
