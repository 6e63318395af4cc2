#include "common/measure/support.h"

#include <algorithm>

#include "common/measure/ensemble.h"
#include "common/shape/convex_distance.h"

namespace talus {
namespace {

/// Something solid in the world with its pieces in world axes; obstacles carry their negative index.
template <int Dim>
struct Solid {
  BodyIndex index = 0;
  int sides = 0;  // see Image
  std::vector<ConvexPiece<Dim>> pieces;
  std::vector<Box<Dim>> piece_bounds;
  Box<Dim> bounds;
};

template <int Dim>
Solid<Dim> make_solid(BodyIndex index, const std::vector<ConvexPiece<Dim>>& pieces, const Pose<Dim>& pose) {
  Solid<Dim> solid;
  solid.index = index;
  for (const ConvexPiece<Dim>& piece : pieces) {
    solid.pieces.push_back(moved(piece, pose));
    solid.piece_bounds.push_back(solid.pieces.back().bounds());
    solid.bounds.extend(solid.piece_bounds.back());
  }
  return solid;
}

template <int Dim>
bool farther(const Box<Dim>& a, const Box<Dim>& b, double reach) {
  return a.squaredExteriorDistance(b) > reach * reach;
}

/// Distance of the nearest pieces, or `reach` if none are nearer; between overlapping pieces the deepest counts.
template <int Dim>
double solid_distance(const Solid<Dim>& a, const Solid<Dim>& b, double reach) {
  double nearest = reach;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    if (farther(a.piece_bounds[i], b.bounds, reach)) continue;
    for (std::size_t j = 0; j < b.pieces.size(); ++j) {
      if (farther(a.piece_bounds[i], b.piece_bounds[j], reach)) continue;
      nearest = std::min(nearest, signed_distance(a.pieces[i], b.pieces[j], reach));
    }
  }
  return nearest;
}

/// Of bodies behind the upper sides, of obstacles behind all.
template <int Dim>
void append_images(const Periodic<Dim>& sides, std::vector<Solid<Dim>>& all) {
  const std::size_t known = all.size();
  for (std::size_t i = 0; sides.any() && i < known; ++i) {
    const std::vector<Vec<Dim>> shifts = sides.shifts(all[i].index < 0 ? -1 : 0);
    for (std::size_t image = 1; image < shifts.size(); ++image) {
      const Pose<Dim> shift{shifts[image], Rotation<Dim>::Identity()};
      all.push_back(make_solid(all[i].index, all[i].pieces, shift));
      all.back().sides = static_cast<int>(image);
    }
  }
}

template <int Dim>
std::vector<Solid<Dim>> solids(const WorldDescription<Dim>& description, const BodyStates<Dim>& states) {
  std::vector<Solid<Dim>> all;
  for (std::size_t k = 0; k < description.obstacles.size(); ++k) {
    const Obstacle<Dim>& obstacle = description.obstacles[k];
    all.push_back(make_solid(first_obstacle - static_cast<BodyIndex>(k), convex_pieces(obstacle.shape), obstacle.pose));
  }
  std::vector<std::vector<ConvexPiece<Dim>>> shapes;
  shapes.reserve(description.shapes.size());
  for (const Shape<Dim>& shape : description.shapes) shapes.push_back(convex_pieces(shape));
  for (BodyIndex i = 0; i < states.size(); ++i) {
    if (states.removed[i]) continue;
    all.push_back(make_solid(i, shapes[states.shape[i]], states.pose[i]));
  }
  append_images(description.periodic(), all);
  return all;
}

/// See Image: those that touch only as other images do not meet.
template <int Dim>
bool meet(const Solid<Dim>& a, const Solid<Dim>& b) {
  if (a.index < 0) return b.index >= 0 && b.sides == 0;
  return b.index < 0 ? a.sides == 0 : (a.sides & b.sides) == 0;
}

}  // namespace

template <int Dim>
std::vector<Touch> touching_pairs(const WorldDescription<Dim>& description, const BodyStates<Dim>& states,
                                  double reach) {
  std::vector<Solid<Dim>> all = solids(description, states);
  std::vector<Touch> touches;
  if (description.ground.present) {
    for (const Solid<Dim>& solid : all) {
      const double above = height<Dim>(solid.bounds.min()) - description.ground.height;
      if (solid.index >= 0 && solid.sides == 0 && above < reach) touches.push_back({solid.index, ground_index, above});
    }
  }
  // Sweep along x: only solids whose intervals overlap are compared.
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.bounds.min().x() < b.bounds.min().x(); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size() && all[j].bounds.min().x() < all[i].bounds.max().x() + reach; ++j) {
      if (!meet(all[i], all[j])) continue;
      if (farther(all[i].bounds, all[j].bounds, reach)) continue;
      const double distance = solid_distance(all[i], all[j], reach);
      if (distance >= reach) continue;
      const auto [low, high] = std::minmax(all[i].index, all[j].index);
      touches.push_back(low < 0 ? Touch{high, low, distance} : Touch{low, high, distance});
    }
  }
  std::sort(touches.begin(), touches.end(),
            [](const Touch& s, const Touch& t) { return s.a < t.a || (s.a == t.a && s.b < t.b); });
  return touches;
}

template <int Dim>
std::vector<BodyIndex> floating_sleepers(const BodyStates<Dim>& states, std::span<const Touch> touches) {
  std::vector<std::vector<BodyIndex>> neighbours(states.size());
  std::vector<std::uint8_t> carried(states.size(), 0);
  std::vector<BodyIndex> open;
  const auto carry = [&](BodyIndex body) {
    if (carried[body]) return;
    carried[body] = 1;
    open.push_back(body);
  };
  for (const Touch& touch : touches) {
    if (touch.b < 0) {
      carry(touch.a);
    } else {
      neighbours[touch.a].push_back(touch.b);
      neighbours[touch.b].push_back(touch.a);
    }
  }
  while (!open.empty()) {
    const BodyIndex body = open.back();
    open.pop_back();
    for (const BodyIndex neighbour : neighbours[body]) carry(neighbour);
  }
  std::vector<BodyIndex> floating;
  for (BodyIndex i = 0; i < states.size(); ++i)
    if (states.asleep[i] && !states.removed[i] && !carried[i]) floating.push_back(i);
  return floating;
}

Penetration penetration(std::span<const Touch> touches) {
  std::vector<double> depths;
  depths.reserve(touches.size());
  for (const Touch& touch : touches) depths.push_back(std::max(-touch.distance, 0.0));
  Penetration result;
  result.pairs = static_cast<int>(depths.size());
  result.mean = mean(depths);
  result.p99 = quantile(depths, 0.99);
  result.max = quantile(depths, 1.0);
  return result;
}

template std::vector<Touch> touching_pairs(const WorldDescription<2>&, const BodyStates<2>&, double);
template std::vector<Touch> touching_pairs(const WorldDescription<3>&, const BodyStates<3>&, double);
template std::vector<BodyIndex> floating_sleepers(const BodyStates<2>&, std::span<const Touch>);
template std::vector<BodyIndex> floating_sleepers(const BodyStates<3>&, std::span<const Touch>);

}  // namespace talus
