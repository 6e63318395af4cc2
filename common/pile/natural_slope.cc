#include "common/pile/natural_slope.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {

template <int Dim>
double natural_slope(std::vector<Vec<Dim>>& places) {
  constexpr double degree = std::numbers::pi / 180.0;
  double sum_of_heights = 0.0;
  for (const Vec<Dim>& place : places) sum_of_heights += height<Dim>(place);
  const auto from_axis = [](const Vec<Dim>& place) { return horizontal<Dim>(place).norm(); };
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::ranges::nth_element(places, middle, {}, from_axis);
  constexpr double median_share = Dim == 3 ? 0.5 : 1.0 - std::numbers::sqrt2 / 2.0;  // of the radius
  constexpr double centre_share = Dim == 3 ? 0.25 : 1.0 / 3.0;                       // of the height
  const double radius = from_axis(*middle) / median_share;
  const double apex = sum_of_heights / static_cast<double>(places.size()) / centre_share;
  return std::clamp(std::atan2(apex, radius), 5.0 * degree, steepest_slope);
}

template double natural_slope(std::vector<Vec<2>>&);
template double natural_slope(std::vector<Vec<3>>&);

}  // namespace talus
