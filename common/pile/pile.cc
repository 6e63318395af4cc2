#include "common/pile/pile.h"

#include <algorithm>
#include <cmath>

#include "common/pile/profile.h"

namespace talus {

template <int Dim>
Pile<Dim> make_pile(const Vec<Dim>& centre, double alpha, double structure_size, const TypicalBody& body) {
  Pile<Dim> pile;
  pile.centre = centre;
  pile.alpha = alpha;
  pile.structure_size = structure_size;
  pile.radius = Profile<Dim>::base_radius(structure_size * body.bounding_volume, alpha);
  pile.height = pile.radius * std::tan(alpha);
  const int layer_count = std::max(1, static_cast<int>(std::floor(pile.height / body.extent)));
  const double thickness = pile.height / layer_count;
  const auto radius_at = [&](int cut) { return pile.radius * (layer_count - cut) / layer_count; };
  for (int i = 0; i < layer_count; ++i) {
    Layer layer;
    layer.bottom = i * thickness;
    layer.top = (i + 1) * thickness;
    layer.radius = radius_at(i);
    layer.volume = Profile<Dim>::slice_volume(radius_at(i), radius_at(i + 1), thickness);
    layer.capacity = layer.volume / body.bounding_volume;
    pile.layers.push_back(layer);
  }
  return pile;
}

template <int Dim>
int Pile<Dim>::layer_of(const Vec<Dim>& point) const {
  const double above = talus::height<Dim>(point) - talus::height<Dim>(centre);
  if (above < 0.0 || layers.empty()) return -1;
  const int last = static_cast<int>(layers.size()) - 1;
  const double thickness = layers.front().top;
  const int layer = above >= height ? last : std::min(last, static_cast<int>(above / thickness));
  const double distance = (horizontal<Dim>(point) - horizontal<Dim>(centre)).norm();
  return distance <= layers[static_cast<std::size_t>(layer)].radius ? layer : -1;
}

template <int Dim>
double Pile<Dim>::occupation_ratio() const {
  double count = 0.0;
  double capacity = 0.0;
  for (const Layer& layer : layers) {
    count += layer.count;
    capacity += layer.capacity;
  }
  return capacity > 0.0 ? count / capacity : 0.0;
}

template struct Pile<2>;
template struct Pile<3>;
template Pile<2> make_pile(const Vec<2>&, double, double, const TypicalBody&);
template Pile<3> make_pile(const Vec<3>&, double, double, const TypicalBody&);

}  // namespace talus
