#include "tools/picture/framing.h"

#include <algorithm>

#include "tools/picture/layers.h"
#include "tools/picture/periodic_sides.h"

namespace talus {
namespace {

constexpr double fence_widths = 1.5;
constexpr double obstacle_sizes = 2.5;  // an obstacle this many times larger than all else does not set the frame

template <int Dim>
std::vector<BodyIndex> present_bodies(const BodyStates<Dim>& states) {
  std::vector<BodyIndex> present;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.removed[body] == 0) present.push_back(body);
  return present;
}

/// Box whose inside counts as near the other bodies, `reach` being a length that is near in any case.
template <int Dim>
Box<Dim> fence_of(const BodyStates<Dim>& states, const std::vector<BodyIndex>& present, double reach) {
  Box<Dim> fence;
  std::vector<double> values(present.size());
  for (int axis = 0; axis < Dim; ++axis) {
    for (std::size_t i = 0; i < present.size(); ++i) values[i] = states.pose[present[i]].position[axis];
    std::sort(values.begin(), values.end());
    const double lower = values[(values.size() - 1) / 4];
    const double upper = values[(3 * (values.size() - 1) + 3) / 4];
    const double width = fence_widths * (upper - lower) + reach;
    fence.min()[axis] = lower - width;
    fence.max()[axis] = upper + width;
  }
  return fence;
}

/// Rims of all layers; none for a pile that merged into another.
template <int Dim>
std::vector<Vec<Dim>> rims_of(const Pile<Dim>& pile) {
  std::vector<Vec<Dim>> rims;
  for (const Layer& layer : pile.layers) {
    for (const double height : {layer.bottom, layer.top}) {
      const std::vector<Vec<Dim>> rim = layer_rim(pile, layer, height);
      rims.insert(rims.end(), rim.begin(), rim.end());
    }
  }
  return rims;
}

template <int Dim>
void include(Framing<Dim>& framing, const Box<Dim>& box) {
  for (int corner = 0; corner < (1 << Dim); ++corner)
    framing.points.push_back(box.corner(static_cast<typename Box<Dim>::CornerType>(corner)));
  framing.box.extend(box);
}

template <int Dim>
void include_bodies(Framing<Dim>& framing, const PictureInput<Dim>& input, const std::vector<Box<Dim>>& piles) {
  const std::vector<BodyIndex> present = present_bodies(input.states);
  if (present.empty()) return;
  double largest = 0.0;
  for (const Shape<Dim>& shape : input.shapes) largest = std::max(largest, shape.extent);
  const Box<Dim> fence = fence_of(input.states, present, 2.0 * largest);
  const auto position = [&](BodyIndex body) -> const Vec<Dim>& { return input.states.pose[body].position; };
  const auto bounds = [&](BodyIndex body) {
    return bounds_at(input.shapes[input.states.shape[body]], input.states.pose[body]);
  };
  for (const BodyIndex body : present) {
    const bool near = fence.contains(position(body)) ||
                      std::ranges::any_of(piles, [&](const Box<Dim>& box) { return box.contains(position(body)); });
    (near ? framing.drawn : framing.outside).push_back(body);
  }
  if (framing.drawn.empty()) {
    // Each is far off on one axis or another: there is no middle to be far from.
    std::swap(framing.drawn, framing.outside);
  }
  for (const BodyIndex body : framing.drawn) include(framing, bounds(body));
  // The others from the nearest on, as long as none is further from what is seen than that is large.
  std::ranges::sort(framing.outside, {},
                    [&](BodyIndex body) { return framing.box.squaredExteriorDistance(position(body)); });
  auto far = framing.outside.begin();
  for (; far != framing.outside.end(); ++far) {
    if (framing.box.exteriorDistance(position(*far)) > framing.box.diagonal().norm()) break;
    include(framing, bounds(*far));
  }
  framing.drawn.insert(framing.drawn.end(), framing.outside.begin(), far);
  framing.outside.erase(framing.outside.begin(), far);
  std::ranges::sort(framing.drawn);
  std::ranges::sort(framing.outside);
}

}  // namespace

template <int Dim>
Framing<Dim> framing_of(const PictureInput<Dim>& input) {
  Framing<Dim> framing;
  std::vector<Box<Dim>> piles;
  for (const Pile<Dim>& pile : input.piles) {
    Box<Dim>& box = piles.emplace_back();
    for (const Vec<Dim>& point : rims_of(pile)) {
      framing.points.push_back(point);
      box.extend(point);
    }
    framing.box.extend(box);
  }
  include_bodies(framing, input, piles);
  const double size = framing.box.isEmpty() ? 0.0 : framing.box.diagonal().norm();
  for (const Obstacle<Dim>& obstacle : input.obstacles) {
    const Box<Dim> box = bounds_at(obstacle.shape, obstacle.pose);
    if (size == 0.0 || box.diagonal().norm() < obstacle_sizes * size) include(framing, box);
  }
  if (framing.box.isEmpty())
    include(framing, Box<Dim>(Vec<Dim>(Vec<Dim>::Constant(-1.0)), Vec<Dim>(Vec<Dim>::Constant(1.0))));
  if (input.sides.any()) include(framing, between_sides(input.sides, framing.box));
  return framing;
}

template Framing<2> framing_of(const PictureInput<2>& input);
template Framing<3> framing_of(const PictureInput<3>& input);

}  // namespace talus
