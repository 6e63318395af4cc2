#include "common/pile/angle_of_repose.h"

#include <algorithm>
#include <cmath>

namespace talus {

template <int Dim>
double estimate_angle_of_repose(std::vector<Vec<Dim>>& positions) {
  double sum_of_heights = 0.0;
  for (const Vec<Dim>& position : positions) sum_of_heights += height<Dim>(position);
  const auto from_axis = [](const Vec<Dim>& position) { return horizontal<Dim>(position).norm(); };
  const auto middle = positions.begin() + static_cast<std::ptrdiff_t>(positions.size() / 2);
  std::ranges::nth_element(positions, middle, {}, from_axis);
  constexpr double median_share = Dim == 3 ? 0.5 : 1.0 - std::numbers::sqrt2 / 2.0;  // of the radius
  constexpr double centre_share = Dim == 3 ? 0.25 : 1.0 / 3.0;                       // of the height
  const double radius = from_axis(*middle) / median_share;
  const double apex = sum_of_heights / static_cast<double>(positions.size()) / centre_share;
  return std::clamp(std::atan2(apex, radius), min_angle_of_repose, max_angle_of_repose);
}

template double estimate_angle_of_repose(std::vector<Vec<2>>&);
template double estimate_angle_of_repose(std::vector<Vec<3>>&);

}  // namespace talus
