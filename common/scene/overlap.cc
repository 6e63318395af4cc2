#include "common/scene/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/shape/convex_distance.h"

namespace talus {
namespace {

/// The cell, of the given width [m], that holds a position.
template <int Dim>
std::array<int, Dim> cell_of(const Vec<Dim>& position, double width) {
  std::array<int, Dim> cell{};
  for (int axis = 0; axis < Dim; ++axis) cell[axis] = static_cast<int>(std::floor(position[axis] / width));
  return cell;
}

/// By how much two boxes overlap [m] along the axis where they do least; negative where they are apart.
template <int Dim>
double box_overlap(const Box<Dim>& a, const Box<Dim>& b) {
  return (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).minCoeff();
}

}  // namespace

template <int Dim>
std::size_t OverlapCheck<Dim>::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const int number : cell) hash = (hash ^ static_cast<std::uint32_t>(number)) * 0x100000001b3U;
  return hash;
}

template <int Dim>
OverlapCheck<Dim>::OverlapCheck(const WorldDescription<Dim>& world) : world_(world) {
  for (const Shape<Dim>& shape : world.shapes) shapes_.push_back(convex_pieces(shape));
  for (const Obstacle<Dim>& obstacle : world.obstacles) {
    Solid solid = make_solid(obstacle.shape, convex_pieces(obstacle.shape), obstacle.pose);
    solid.name = static_cast<int>(names_.size());
    names_.push_back(obstacle.shape.name);
    obstacles_.push_back(std::move(solid));
  }
}

template <int Dim>
typename OverlapCheck<Dim>::Solid OverlapCheck<Dim>::make_solid(const Shape<Dim>& shape, const Pieces& pieces,
                                                                const Pose<Dim>& pose) const {
  Solid solid{.pieces = {}, .bounds = bounds_at(shape, pose), .fixed = true};
  solid.pieces.reserve(pieces.size());
  for (const ConvexPiece<Dim>& piece : pieces) solid.pieces.push_back(moved(piece, pose));
  return solid;
}

template <int Dim>
void OverlapCheck<Dim>::compare(const Solid& body, const Solid& other, Overlap& deepest) const {
  if (body.fixed && other.fixed) return;
  if (box_overlap(body.bounds, other.bounds) <= most_overlap) return;
  for (const ConvexPiece<Dim>& a : body.pieces) {
    for (const ConvexPiece<Dim>& b : other.pieces) {
      if (box_overlap(a.bounds(), b.bounds()) <= most_overlap) continue;
      const double depth = -signed_distance(a, b, -most_overlap);
      if (depth > std::max(deepest.depth, most_overlap)) deepest = {depth, name_of(other)};
    }
  }
}

template <int Dim>
std::string OverlapCheck<Dim>::name_of(const Solid& solid) const {
  return solid.number < 0 ? names_[solid.name] : fmt::format("body {} of {}", solid.number, names_[solid.name]);
}

/// With the bodies in the cells that the body reaches, or with all where these are more cells than bodies.
template <int Dim>
void OverlapCheck<Dim>::compare_near(const Solid& body, const Level& level, Overlap& deepest) const {
  const Vec<Dim> reach = Vec<Dim>::Constant(0.5 * level.width);
  const Cell first = cell_of<Dim>(body.bounds.min() - reach, level.width);
  const Cell last = cell_of<Dim>(body.bounds.max() + reach, level.width);
  double cells = 1.0;
  for (int axis = 0; axis < Dim; ++axis) cells *= last[axis] - first[axis] + 1.0;
  if (cells > static_cast<double>(level.bodies.size())) {
    for (const int other : level.bodies) compare(body, bodies_[other], deepest);
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
    for (const int other : found->second) compare(body, bodies_[other], deepest);
  }
}

template <int Dim>
void OverlapCheck<Dim>::keep(Solid body, const Vec<Dim>& position, double width) {
  const double least = std::exp2(std::ceil(std::log2(width)));
  const auto is_its_own = [&](const Level& level) { return level.width == least && level.fixed == body.fixed; };
  auto level = std::find_if(levels_.begin(), levels_.end(), is_its_own);
  if (level == levels_.end())
    level = levels_.insert(levels_.end(), {.width = least, .fixed = body.fixed, .bodies = {}, .cells = {}});
  const int index = static_cast<int>(bodies_.size());
  level->bodies.push_back(index);
  level->cells[cell_of<Dim>(position, least)].push_back(index);
  bodies_.push_back(std::move(body));
}

template <int Dim>
Overlap OverlapCheck<Dim>::add(int shape, const Pose<Dim>& pose, bool fixed, const std::string& path) {
  Solid body = make_solid(world_.shapes[shape], shapes_[shape], pose);
  body.fixed = fixed;
  Overlap deepest;
  const double in_ground = world_.ground.height - height<Dim>(body.bounds.min());
  if (!fixed && world_.ground.present && in_ground > most_overlap) deepest = {in_ground, "the ground"};
  if (!fixed)
    for (const Solid& obstacle : obstacles_) compare(body, obstacle, deepest);
  for (const Level& level : levels_)
    if (!fixed || !level.fixed) compare_near(body, level, deepest);
  if (names_.empty() || names_.back() != path) names_.push_back(path);
  body.name = static_cast<int>(names_.size()) - 1;
  body.number = bodies_.empty() || bodies_.back().name != body.name ? 0 : bodies_.back().number + 1;
  keep(std::move(body), pose.position, 2.0 * bounding_radius(world_.shapes[shape]));
  return deepest;
}

template class OverlapCheck<2>;
template class OverlapCheck<3>;

}  // namespace talus
