#include "common/simulation/moving_obstacles.h"

#include <algorithm>

#include "common/scene/typical_body.h"
#include "common/shape/convex_distance.h"

namespace talus {

template <int Dim>
MovingObstacles<Dim>::MovingObstacles(const Scene<Dim>& scene) : movers_(scene.movers), dt_(scene.world.dt) {
  if (movers_.empty()) return;
  margin_ = touching_distance * typical_body(scene).extent;
  obstacles_ = scene.world.obstacles;
  for (const Shape<Dim>& shape : scene.world.shapes) bodies_.push_back(convex_pieces(shape));
  pieces_.resize(obstacles_.size());
  for (const Mover<Dim>& mover : movers_)
    for (int k = mover.first; k < mover.first + mover.count; ++k) pieces_[k] = convex_pieces(obstacles_[k].shape);
}

template <int Dim>
const std::vector<BodyIndex>& MovingObstacles<Dim>::move(World<Dim>& world, double time) {
  moving_.clear();
  touched_.clear();
  for (const Mover<Dim>& mover : movers_)
    for (int k = mover.first; k < mover.first + mover.count; ++k) move(world, mover, k, time);
  for (const Piece& piece : moving_) find_sleepers(world, piece);
  return touched_;
}

template <int Dim>
void MovingObstacles<Dim>::move(World<Dim>& world, const Mover<Dim>& mover, int obstacle, double time) {
  if (!world.has_obstacle(obstacle)) return;
  const Pose<Dim> from = world.obstacle_pose(obstacle);
  const Pose<Dim> to = mover.pose_at(time + dt_, obstacles_[obstacle].pose);
  const Vec<Dim> belt = mover.motion.belt_at(time);
  if (belt != world.surface_velocity(obstacle)) world.set_surface_velocity(obstacle, belt);
  if (from == to && belt.isZero(0.0)) return;
  if (from != to) world.move_obstacle(obstacle, to);
  for (const ConvexPiece<Dim>& piece : pieces_[obstacle]) {
    const ConvexPiece<Dim> before = moved(piece, from);
    Piece moving{.obstacle = obstacle, .belt = !belt.isZero(0.0), .piece = moved(piece, to), .bounds = before.bounds()};
    for (std::size_t i = 0; i < before.corners.size(); ++i)
      moving.travel = std::max(moving.travel, (moving.piece.corners[i] - before.corners[i]).norm());
    moving.bounds.extend(moving.piece.bounds());
    moving_.push_back(std::move(moving));
  }
}

template <int Dim>
void MovingObstacles<Dim>::find_sleepers(const World<Dim>& world, const Piece& piece) {
  const Vec<Dim> reach = Vec<Dim>::Constant(margin_);
  near_.clear();
  world.query_box({piece.bounds.min() - reach, piece.bounds.max() + reach}, near_);
  for (const BodyIndex body : near_)
    if (world.states().asleep[body] != 0 && (piece.belt || !world.feels(body, first_obstacle - piece.obstacle)) &&
        touches(world, piece, body))
      touched_.push_back(body);
}

template <int Dim>
bool MovingObstacles<Dim>::touches(const World<Dim>& world, const Piece& piece, BodyIndex body) const {
  const double reach = margin_ + piece.travel;
  const Pose<Dim> pose = world.pose_near(body, piece.bounds.center());
  if (bounds_at(world.shape_of(body), pose).squaredExteriorDistance(piece.bounds) > reach * reach) return false;
  return std::ranges::any_of(bodies_[world.states().shape[body]], [&](const ConvexPiece<Dim>& own) {
    return signed_distance(moved(own, pose), piece.piece, reach) < reach;
  });
}

template <int Dim>
bool MovingObstacles<Dim>::keep_awake(const World<Dim>& world, BodyIndex body) const {
  return std::ranges::any_of(
      moving_, [&](const Piece& piece) { return (piece.belt || !world.has_ring()) && touches(world, piece, body); });
}

template <int Dim>
Pose<Dim> MovingObstacles<Dim>::pose_at(const World<Dim>& world, int obstacle, double time) const {
  for (const Mover<Dim>& mover : movers_)
    if (obstacle >= mover.first && obstacle < mover.first + mover.count)
      return mover.pose_at(time, obstacles_[obstacle].pose);
  return world.obstacle_pose(obstacle);
}

template <int Dim>
bool MovingObstacles<Dim>::moves_after(const World<Dim>& world, double time) const {
  for (const Mover<Dim>& mover : movers_)
    for (int obstacle = mover.first; obstacle < mover.first + mover.count; ++obstacle)
      if (world.has_obstacle(obstacle) && mover.motion.moves_after(time)) return true;
  return false;
}

template class MovingObstacles<2>;
template class MovingObstacles<3>;

}  // namespace talus
