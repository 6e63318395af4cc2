#include "common/simulation/passing_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shape/convex_distance.h"
#include "common/shape/shape.h"

namespace talus {
namespace {

constexpr double largest_turn = 0.2;  // of a part of a path that is taken as straight [rad]
constexpr int fast_to_share = 64;     // with fewer, threads would wait longer than they work
constexpr double depth_limit = 0.25;  // that a path may lead into a body [its smallest width]

/// Square of the way of a point at distance 1 from the axis, at most [m²].
double squared_turn(const Rotation<2>& from, const Rotation<2>& to) {
  const double angle = to.angle() - from.angle();
  if (std::abs(angle) < 1.0) return angle * angle;
  const double half_chord = std::sin(0.5 * angle);  // an engine may have wrapped the angle
  return 4.0 * half_chord * half_chord;
}
double squared_turn(const Rotation<3>& from, const Rotation<3>& to) {
  const double cosine = from.dot(to);
  return 4.0 * std::max(0.0, 1.0 - cosine * cosine);
}

template <int Dim>
Vec<Dim> into_axes_of(const Pose<Dim>& pose, const Vec<Dim>& point) {
  return pose.rotation.inverse() * (point - pose.position);
}

}  // namespace

template <int Dim>
auto PassingWatch<Dim>::solid_of(const Shape<Dim>& shape) -> Solid {
  Solid solid;
  for (ConvexPiece<Dim>& piece : convex_pieces(shape)) {
    const Box<Dim> bounds = piece.bounds();
    solid.pieces.push_back({std::move(piece), bounds});
  }
  solid.reach = bounding_radius(shape);
  const double main = thickness(shape);
  solid.core = 0.5 * main;
  solid.width = least_width(shape);
  for (const Piece<Dim>& piece : shape.pieces)
    if (smallest_width<Dim>(piece) >= main) solid.middles.push_back(mass_properties<Dim>(piece).centre);
  return solid;
}

template <int Dim>
PassingWatch<Dim>::PassingWatch(std::span<const Shape<Dim>> shapes, std::span<const Obstacle<Dim>> obstacles)
    : smallest_core_(std::numeric_limits<double>::infinity()) {
  for (const Shape<Dim>& shape : shapes) {
    solids_.push_back(solid_of(shape));
    smallest_core_ = std::min(smallest_core_, solids_.back().core);
  }
  for (const Obstacle<Dim>& obstacle : obstacles) {
    obstacles_.push_back(solid_of(obstacle.shape));
    obstacles_from_.push_back(obstacle.pose);
  }
}

template <int Dim>
void PassingWatch<Dim>::start_step(const World<Dim>& world) {
  const std::vector<Pose<Dim>>& pose = world.states().pose;
  from_.resize(pose.size());
  for (const BodyIndex body : world.awake()) from_[body] = pose[body];
  for (int k = 0; k < std::ssize(obstacles_); ++k)
    if (world.obstacles()[k].moves) obstacles_from_[k] = world.obstacle_pose(k);
}

template <int Dim>
auto PassingWatch<Dim>::mover(const World<Dim>& world, BodyIndex index) const -> Mover {
  if (index <= first_obstacle) {
    const int number = first_obstacle - index;
    return {index, &obstacles_[number], obstacles_from_[number], world.obstacle_pose(number)};
  }
  const BodyStates<Dim>& states = world.states();
  const Pose<Dim>& to = states.pose[index];
  const Pose<Dim> from = states.asleep[index] != 0 ? to : world.periodic().near(from_[index], to.position);
  return {index, &solids_[states.shape[index]], from, to};
}

/// How far any point of it goes by its rotation, at most.
template <int Dim>
double PassingWatch<Dim>::turn(const Mover& mover) {
  return mover.solid->reach * std::sqrt(squared_turn(mover.from.rotation, mover.to.rotation));
}

template <int Dim>
Box<Dim> PassingWatch<Dim>::swept(const Mover& mover) {
  Box<Dim> box(mover.from.position);
  box.extend(mover.to.position);
  const Vec<Dim> reach = Vec<Dim>::Constant(mover.solid->reach);
  return {box.min() - reach, box.max() + reach};
}

template <int Dim>
auto PassingWatch<Dim>::end_step(const World<Dim>& world) -> std::span<const Finding> {
  findings_.clear();
  fast_.clear();
  double farthest = 0.0;
  // (a + b)² is at most 2 (a² + b²): most bodies are slow, and are found to be without a root.
  const double slow = 0.125 * smallest_core_ * smallest_core_;
  const auto note = [&](const Mover& mover) {
    const double way = (mover.to.position - mover.from.position).norm() + turn(mover);
    if (way < 0.5 * smallest_core_) return;  // two such bodies together stay below the limit of a pair
    farthest = std::max(farthest, way);
    fast_.push_back(mover);
  };
  const BodyStates<Dim>& states = world.states();
  for (const BodyIndex body : world.awake()) {
    const Pose<Dim>&from = from_[body], &to = states.pose[body];
    const double reach = solids_[states.shape[body]].reach;
    const double squared_way =
        (to.position - from.position).squaredNorm() + reach * reach * squared_turn(from.rotation, to.rotation);
    if (squared_way >= slow) note(mover(world, body));
  }
  for (int k = 0; k < std::ssize(obstacles_); ++k)
    if (world.obstacles()[k].moves && world.has_obstacle(k)) note(mover(world, first_obstacle - k));
  if (!fast_.empty()) test_all(world, farthest);
  return findings_;
}

/// The first alone: it readies the world for searches side by side.
template <int Dim>
void PassingWatch<Dim>::test_all(const World<Dim>& world, double margin) {
  const std::span<const Mover> others = std::span(fast_).subspan(1);
  Team& team = world.team();
  searches_.resize(std::max(searches_.size(), static_cast<std::size_t>(team.size())));
  for (Search& search : searches_) search.findings.clear();
  test_neighbours(world, fast_.front(), margin, searches_.front());
  const auto test_part = [&](int first, int last, int member) {
    for (int i = first; i < last; ++i) test_neighbours(world, others[i], margin, searches_[member]);
  };
  const auto count = static_cast<int>(others.size());
  if (count < fast_to_share)
    test_part(0, count, 0);
  else
    team.divide(count, test_part);
  for (const Search& search : searches_)
    findings_.insert(findings_.end(), search.findings.begin(), search.findings.end());
  std::ranges::sort(findings_, {}, [](const Finding& each) { return std::pair(each.body, each.way); });
}

template <int Dim>
void PassingWatch<Dim>::test_neighbours(const World<Dim>& world, const Mover& fast, double margin,
                                        Search& search) const {
  const Box<Dim> box = swept(fast);
  search.near.clear();
  world.query_box({box.min().array() - margin, box.max().array() + margin}, search.near);
  const auto meet = [&](const Mover& other) { test(fast, other, search.findings); };
  for (const BodyIndex other : search.near)
    if (other != fast.index) meet(image_near(world.periodic(), mover(world, other), fast.to.position));
  if (fast.index < 0) return;
  for (int k = 0; k < std::ssize(obstacles_); ++k)
    if (world.has_obstacle(k)) meet(image_near(world.periodic(), mover(world, first_obstacle - k), fast.to.position));
}

template <int Dim>
auto PassingWatch<Dim>::image_near(const Periodic<Dim>& sides, Mover mover, const Vec<Dim>& place) -> Mover {
  const Vec<Dim> to = sides.near(mover.to.position, place);
  mover.from.position += to - mover.to.position;
  mover.to.position = to;
  return mover;
}

template <int Dim>
void PassingWatch<Dim>::test(const Mover& fast, const Mover& other, std::vector<Finding>& findings) const {
  if (!swept(fast).intersects(swept(other)) || way(fast, other) < smallest_core_) return;
  if (!passes(fast, other) && !passes(other, fast)) return;
  findings.push_back({fast.index >= 0 ? fast.index : other.index, way(fast, other)});
}

template <int Dim>
double PassingWatch<Dim>::way(const Mover& a, const Mover& b) {
  return (a.to.position - a.from.position - b.to.position + b.from.position).norm() + turn(a) + turn(b);
}

/// Whether a middle of `a` goes through `b`.
template <int Dim>
bool PassingWatch<Dim>::passes(const Mover& a, const Mover& b) {
  const double angle =
      std::sqrt(std::max(squared_turn(a.from.rotation, a.to.rotation), squared_turn(b.from.rotation, b.to.rotation)));
  const int parts = 1 + static_cast<int>(angle / largest_turn);
  const auto at = [](const Mover& mover, double share) -> Pose<Dim> {
    return {mover.from.position + share * (mover.to.position - mover.from.position),
            mover.from.rotation.slerp(share, mover.to.rotation)};
  };
  for (const Vec<Dim>& middle : a.solid->middles) {
    Vec<Dim> before = into_axes_of<Dim>(b.from, a.from * middle);
    if ((into_axes_of<Dim>(b.to, a.to * middle) - before).norm() < a.solid->core) continue;
    for (int part = 1; part <= parts; ++part) {
      const double share = static_cast<double>(part) / parts;
      const Vec<Dim> after = into_axes_of<Dim>(at(b, share), at(a, share) * middle);
      if (enters(before, after, *b.solid)) return true;
      before = after;
    }
  }
  return false;
}

/// Whether the path leads through a piece, or so far into it that later steps may push the body out at the far side. A
/// hard impact gets a little way in, and the engine pushes the body back.
template <int Dim>
bool PassingWatch<Dim>::enters(const Vec<Dim>& from, const Vec<Dim>& to, const Solid& solid) {
  Box<Dim> bounds(from);
  bounds.extend(to);
  return std::ranges::any_of(solid.pieces, [&](const auto& part) {
    if (from == to || !bounds.intersects(part.bounds)) return false;
    const ConvexPiece<Dim> path = convex_piece<Dim>(HullPiece<Dim>{.corners = {from, to}, .radius = 0.0});
    return signed_distance<Dim>(path, part.piece, 0.0) < -depth_limit * solid.width;
  });
}

template class PassingWatch<2>;
template class PassingWatch<3>;

}  // namespace talus
