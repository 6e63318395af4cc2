#include "common/scene/typical_body.h"

#include <algorithm>

namespace talus {
namespace {

constexpr double rare = 0.02;  // for each body of the most frequent shape

}  // namespace

template <int Dim>
std::vector<double> bodies_of_piles(const Scene<Dim>& scene) {
  std::vector<double> dropped(scene.world.shapes.size(), scene.bodies_planned() == 0 ? 1.0 : 0.0);
  for (const InitialBody<Dim>& body : scene.bodies) dropped[body.def.shape] += 1.0;
  for (const Source<Dim>& source : scene.sources) {
    const int shapes = source.shapes_of_a_size();
    for (int i = 0; i < std::ssize(source.shapes); ++i)
      dropped[source.shapes[i]] += source.count * source.share_of_size(i / shapes) / shapes;
  }
  const double most = dropped.empty() ? 0.0 : *std::max_element(dropped.begin(), dropped.end());
  for (double& count : dropped)
    if (count < rare * most) count = 0.0;
  return dropped;
}

template <int Dim>
TypicalBody typical_body(const Scene<Dim>& scene) {
  const std::vector<double> dropped = bodies_of_piles(scene);
  TypicalBody mean{.bounding_volume = 0.0, .extent = 0.0, .mass = 0.0};
  double total = 0.0;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    const Shape<Dim>& shape = scene.world.shapes[i];
    if (dropped[i] == 0.0) continue;
    total += dropped[i];
    mean.bounding_volume += dropped[i] * shape.bounding_volume;
    mean.mass += dropped[i] * shape.mass;
    mean.extent = std::max(mean.extent, shape.extent);
  }
  if (total == 0.0) return {};
  mean.bounding_volume /= total;
  mean.mass /= total;
  return mean;
}

template std::vector<double> bodies_of_piles(const Scene<2>&);
template std::vector<double> bodies_of_piles(const Scene<3>&);
template TypicalBody typical_body(const Scene<2>&);
template TypicalBody typical_body(const Scene<3>&);

}  // namespace talus
