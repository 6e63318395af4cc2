#include "common/scene/typical_body.h"

#include <algorithm>

namespace talus {

template <int Dim>
TypicalBody typical_body(const Scene<Dim>& scene) {
  std::vector<double> dropped(scene.world.shapes.size(), scene.sources.empty() ? 1.0 : 0.0);
  for (const Source<Dim>& source : scene.sources) {
    const double each = static_cast<double>(source.count) / static_cast<double>(source.shapes.size());
    for (const int shape : source.shapes) dropped[static_cast<std::size_t>(shape)] += each;
  }
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

template TypicalBody typical_body(const Scene<2>&);
template TypicalBody typical_body(const Scene<3>&);

}  // namespace talus
