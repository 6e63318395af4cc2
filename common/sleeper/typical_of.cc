#include "common/sleeper/typical_of.h"

#include <algorithm>

namespace talus {
namespace {

constexpr double rare = 0.02;  // of the bodies

}  // namespace

template <int Dim>
TypicalBody typical_of(const std::vector<const Shape<Dim>*>& shapes) {
  TypicalBody mean{.bounding_volume = 0.0, .extent = 0.0, .mass = 0.0};
  std::vector<double> extents;
  const double share = 1.0 / static_cast<double>(shapes.size());
  for (const Shape<Dim>* shape : shapes) {
    mean.bounding_volume += share * shape->bounding_volume;
    mean.mass += share * shape->mass;
    extents.push_back(shape->extent);
  }
  std::ranges::sort(extents);
  mean.extent = extents[static_cast<std::size_t>((1.0 - rare) * static_cast<double>(extents.size() - 1))];
  return mean;
}

template TypicalBody typical_of<2>(const std::vector<const Shape<2>*>&);
template TypicalBody typical_of<3>(const std::vector<const Shape<3>*>&);

}  // namespace talus
