#include "common/scene/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/grid.h"
#include "common/math/hash.h"
#include "common/shape/convex_distance.h"

namespace talus {
namespace {

/// By how much two boxes overlap [m] along the axis where they do least; negative where they are apart.
template <int Dim>
double box_overlap(const Box<Dim>& a, const Box<Dim>& b) {
  return (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).minCoeff();
}

}  // namespace

template <int Dim>
std::size_t OverlapCheck<Dim>::CellHash::operator()(const Cell& cell) const {
  Fnv1a hash;
  for (const int number : cell) hash.add(static_cast<std::uint64_t>(number));
  return hash.value();
}

template <int Dim>
OverlapCheck<Dim>::OverlapCheck(const WorldDescription<Dim>& world, std::span<const std::uint8_t> absent)
    : world_(world), allowed_(overlap_allowed(world.units)) {
  for (const Shape<Dim>& shape : world.shapes) shapes_.push_back(convex_pieces(shape));
  for (std::size_t k = 0; k < world.obstacles.size(); ++k) {
    if (!absent.empty() && absent[k] != 0) continue;
    const Obstacle<Dim>& obstacle = world.obstacles[k];
    keep({.pieces = static_cast<int>(obstacles_.size()),
          .pose = obstacle.pose,
          .bounds = bounds_at(obstacle.shape, obstacle.pose),
          .fixed = true,
          .name = static_cast<int>(names_.size())},
         2.0 * bounding_radius(obstacle.shape));
    obstacles_.push_back(convex_pieces_at(obstacle.shape, obstacle.pose));
    names_.push_back(obstacle.shape.name);
  }
}

template <int Dim>
std::span<const ConvexPiece<Dim>> OverlapCheck<Dim>::pieces_of(const Solid& solid, Pieces& room) const {
  if (solid.number < 0) return obstacles_[solid.pieces];
  room = shapes_[solid.pieces];
  for (ConvexPiece<Dim>& piece : room) piece = moved(std::move(piece), solid.pose);
  return room;
}

template <int Dim>
void OverlapCheck<Dim>::compare(Added& added, const Solid& other) const {
  const auto& [body, pieces, deepest] = added;
  if (body.fixed && other.fixed) return;
  if (box_overlap(body.bounds, other.bounds) <= allowed_) return;
  if (pieces.empty()) pieces_of(body, added.pieces);
  Pieces room;
  const auto others = pieces_of(other, room);
  for (const ConvexPiece<Dim>& a : pieces) {
    for (const ConvexPiece<Dim>& b : others) {
      if (box_overlap(a.bounds(), b.bounds()) <= allowed_) continue;
      const double depth = -signed_distance(a, b, -allowed_);
      if (depth > std::max(deepest.depth, allowed_)) added.deepest = {depth, name_of(other)};
    }
  }
}

template <int Dim>
std::string OverlapCheck<Dim>::name_of(const Solid& solid) const {
  return solid.number < 0 ? names_[solid.name] : fmt::format("body {} of {}", solid.number, names_[solid.name]);
}

/// With the solids in the cells that the body reaches, or with all where these are more cells than solids.
template <int Dim>
void OverlapCheck<Dim>::compare_near(Added& added, const Level& level) const {
  const Solid& body = added.body;
  const Vec<Dim> reach = Vec<Dim>::Constant(0.5 * level.width);
  const Cell first = Grid<Dim>(level.width).cell_of(body.bounds.min() - reach);
  const Cell last = Grid<Dim>(level.width).cell_of(body.bounds.max() + reach);
  double cells = 1.0;
  for (int axis = 0; axis < Dim; ++axis) cells *= last[axis] - first[axis] + 1.0;
  if (cells > static_cast<double>(level.solids.size())) {
    for (const int other : level.solids) compare(added, solids_[other]);
    return;
  }
  for (int number = 0; number < static_cast<int>(cells); ++number) {
    Cell near{};
    for (int axis = 0, rest = number; axis < Dim; ++axis) {
      const int along = last[axis] - first[axis] + 1;
      near[axis] = first[axis] + rest % along;
      rest /= along;
    }
    const auto found = level.cells.find(near);
    if (found == level.cells.end()) continue;
    for (int other = found->second.first; other >= 0; other = solids_[other].next) compare(added, solids_[other]);
  }
}

template <int Dim>
void OverlapCheck<Dim>::keep(const Solid& solid, double width) {
  const double least = std::exp2(std::ceil(std::log2(width)));
  const auto is_its_own = [&](const Level& level) { return level.width == least && level.fixed == solid.fixed; };
  auto level = std::find_if(levels_.begin(), levels_.end(), is_its_own);
  if (level == levels_.end())
    level = levels_.insert(levels_.end(), {.width = least, .fixed = solid.fixed, .solids = {}, .cells = {}});
  const int index = static_cast<int>(solids_.size());
  level->solids.push_back(index);
  Chain& chain = level->cells[Grid<Dim>(least).cell_of(solid.pose.position)];
  (chain.first < 0 ? chain.first : solids_[chain.last].next) = index;
  chain.last = index;
  solids_.push_back(solid);
}

template <int Dim>
Overlap OverlapCheck<Dim>::add(int shape, const Pose<Dim>& pose, bool fixed, const std::string& path) {
  Solid body{.pieces = shape, .pose = pose, .bounds = bounds_at(world_.shapes[shape], pose), .fixed = fixed};
  if (names_.empty() || names_.back() != path) names_.push_back(path);
  body.name = static_cast<int>(names_.size()) - 1;
  body.number = solids_.empty() || solids_.back().name != body.name ? 0 : solids_.back().number + 1;
  Added added = {.body = body, .pieces = {}, .deepest = {}};
  const double in_ground = world_.ground.height - height<Dim>(body.bounds.min());
  if (!fixed && world_.ground.present && in_ground > allowed_) added.deepest = {in_ground, "the ground"};
  for (const Level& level : levels_)
    if (!fixed || !level.fixed) compare_near(added, level);
  keep(body, 2.0 * bounding_radius(world_.shapes[shape]));
  return added.deepest;
}

template class OverlapCheck<2>;
template class OverlapCheck<3>;

}  // namespace talus
