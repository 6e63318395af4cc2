#include "common/pile/pile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/in_space.h"
#include "common/pile/profile.h"

namespace talus {
namespace {

/// Scale of the cross-section at a height: 1 up to the lift, then shrinking to 0 at the apex.
template <int Dim>
double scale_at(const Pile<Dim>& pile, double above) {
  return above <= pile.lift ? 1.0 : std::max(0.0, (pile.height - above) / (pile.height - pile.lift));
}

/// Volume below a height.
template <int Dim>
double volume_below(const Pile<Dim>& pile, double base, double above) {
  const double tip = tip_volume<Dim>(base, pile.height - pile.lift);
  return base * std::min(above, pile.lift) + tip * (1.0 - std::pow(scale_at(pile, above), Dim));
}

template <int Dim>
void cut_into_layers(Pile<Dim>& pile, double base, const TypicalBody& body) {
  const int layer_count = std::max(1, static_cast<int>(std::floor(pile.height / body.extent)));
  for (int i = 0; i < layer_count; ++i) {
    Layer layer;
    layer.bottom = pile.height * i / layer_count;
    layer.top = pile.height * (i + 1) / layer_count;
    layer.radius = pile.radius * scale_at(pile, layer.bottom);
    layer.volume = volume_below(pile, base, layer.top) - volume_below(pile, base, layer.bottom);
    layer.capacity = layer.volume / body.bounding_volume;
    pile.layers.push_back(layer);
  }
}

}  // namespace

template <int Dim>
int nearest_pile(std::span<const Pile<Dim>> piles, const Vec<Dim>& point) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < piles.size(); ++p) {
    if (piles[p].merged_into >= 0 || !piles[p].reaches(point)) continue;
    const double distance = horizontal<Dim>(Vec<Dim>(point - piles[p].centre)).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = static_cast<int>(p);
  }
  return nearest;
}

template <int Dim>
Pile<Dim> make_pile(const Vec<Dim>& centre, double alpha, double structure_size, const TypicalBody& body,
                    const std::optional<Boundary<Dim>>& boundary) {
  Pile<Dim> pile;
  pile.centre = centre;
  pile.alpha = alpha;
  pile.structure_size = structure_size;
  pile.radius = Profile<Dim>::base_radius(structure_size * body.bounding_volume, alpha);
  double base = Profile<Dim>::base_area(pile.radius);
  if (boundary && pile.radius >= boundary->inner_radius()) {
    pile.boundary = boundary;
    pile.radius = boundary->inner_radius();
    base = boundary->area();
    const double tip = tip_volume<Dim>(base, pile.radius * std::tan(alpha));
    pile.lift = std::clamp((structure_size * body.bounding_volume - tip) / base, 0.0, boundary->rim);
    pile.structure_size = (base * pile.lift + tip) / body.bounding_volume;
  }
  pile.height = pile.lift + pile.radius * std::tan(alpha);
  cut_into_layers(pile, base, body);
  return pile;
}

template <int Dim>
int Pile<Dim>::layer_of(const Vec<Dim>& point) const {
  const double above = talus::height<Dim>(point) - talus::height<Dim>(centre);
  if (above < 0.0 || layers.empty()) return -1;
  const int last = static_cast<int>(layers.size()) - 1;
  const int layer = above >= height ? last : std::min(last, static_cast<int>(above / layers.front().top));
  return closeness(point, layers[layer]) > 0.0 ? layer : -1;
}

template <int Dim>
bool Pile<Dim>::reaches(const Vec<Dim>& point) const {
  return horizontal<Dim>(Vec<Dim>(point - centre)).norm() < 2.0 * radius;
}

template <int Dim>
double Pile<Dim>::closeness(const Vec<Dim>& point, const Layer& layer) const {
  const Horizontal<Dim> offset = horizontal<Dim>(point) - horizontal<Dim>(centre);
  const double distance = boundary ? boundary->gauge(offset) * radius : offset.norm();
  return std::max(layer.radius - distance, 0.0) / layer.radius;
}

template <int Dim>
double Pile<Dim>::occupation_ratio() const {
  double count = 0.0;
  for (const Layer& layer : layers) count += layer.count;
  return count / structure_size;
}

Pile<3> in_space(const Pile<2>& pile) {
  Pile<3> made{.centre = in_space(pile.centre),
               .alpha = pile.alpha,
               .slope_controlled = pile.slope_controlled,
               .structure_size = pile.structure_size,
               .lift = pile.lift,
               .height = pile.height,
               .radius = pile.radius,
               .boundary = {},
               .layers = pile.layers,
               .merged_into = pile.merged_into};
  if (!pile.boundary) return made;
  made.boundary.emplace(Boundary<3>{.rim = pile.boundary->rim});
  for (const Wall<2>& wall : pile.boundary->walls)
    made.boundary->walls.push_back({.normal = {wall.normal.x(), 0.0}, .distance = wall.distance});
  return made;
}

template struct Pile<2>;
template struct Pile<3>;
template int nearest_pile(std::span<const Pile<2>>, const Vec<2>&);
template int nearest_pile(std::span<const Pile<3>>, const Vec<3>&);
template Pile<2> make_pile(const Vec<2>&, double, double, const TypicalBody&, const std::optional<Boundary<2>>&);
template Pile<3> make_pile(const Vec<3>&, double, double, const TypicalBody&, const std::optional<Boundary<3>>&);

}  // namespace talus
