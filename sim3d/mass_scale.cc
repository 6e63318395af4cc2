#include "sim3d/mass_scale.h"

#include <algorithm>
#include <cmath>

namespace talus::bullet {

template <int Dim>
double mass_scale(std::span<const Shape<Dim>> shapes) {
  constexpr int scaled_exponent = 10;  // the heaviest shape weighs 1024 to 2048 units
  double heaviest = 0.0;
  for (const Shape<Dim>& shape : shapes) {
    heaviest = std::max(heaviest, shape.mass);
  }
  if (heaviest == 0.0 || (heaviest >= least_plain_mass && heaviest <= most_plain_mass)) {
    return 1.0;
  }
  return std::ldexp(1.0, scaled_exponent - std::ilogb(heaviest));
}

template double mass_scale(std::span<const Shape<2>>);
template double mass_scale(std::span<const Shape<3>>);

}  // namespace talus::bullet
