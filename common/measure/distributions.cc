#include "common/measure/distributions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace talus {
namespace {

std::vector<double> in_order(std::span<const double> sample) {
  if (sample.empty()) throw std::invalid_argument("sample: must hold at least one number");
  if (!std::ranges::all_of(sample, [](double value) { return std::isfinite(value); }))
    throw std::invalid_argument("sample: numbers must be finite");
  std::vector<double> sorted(sample.begin(), sample.end());
  std::ranges::sort(sorted);
  return sorted;
}

/// The share of a sorted sample that is not above `value`.
double share_up_to(const std::vector<double>& sorted, double value) {
  return static_cast<double>(std::ranges::upper_bound(sorted, value) - sorted.begin()) /
         static_cast<double>(sorted.size());
}

}  // namespace

DistributionDistance distribution_distance(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> of_a = in_order(a);
  const std::vector<double> of_b = in_order(b);
  std::vector<double> both;
  std::ranges::merge(of_a, of_b, std::back_inserter(both));
  DistributionDistance result;
  for (std::size_t i = 0; i + 1 < both.size(); ++i) {
    const double gap = std::abs(share_up_to(of_a, both[i]) - share_up_to(of_b, both[i]));
    result.kolmogorov_smirnov = std::max(result.kolmogorov_smirnov, gap);
    result.wasserstein += gap * (both[i + 1] - both[i]);
    result.energy += 2.0 * gap * gap * (both[i + 1] - both[i]);
  }
  return result;
}

}  // namespace talus
