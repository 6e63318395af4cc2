#include "common/measure/ensemble.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double mean(std::span<const double> values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  // A hair less than q n, so that rounding does not push 0.95 * 20 to the 20th.
  const double rank = std::ceil(q * static_cast<double>(values.size()) - 1e-9);
  const std::size_t index = std::min(static_cast<std::size_t>(std::max(rank, 1.0)) - 1, values.size() - 1);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
  return values[index];
}

MeanWithError mean_with_error(std::span<const double> values) {
  std::vector<double> finite(values.begin(), values.end());
  std::erase_if(finite, [](double value) { return !std::isfinite(value); });
  if (finite.empty()) return {};
  MeanWithError result{.mean = mean(finite)};
  if (finite.size() < 2) return result;
  double squares = 0.0;
  for (const double value : finite) squares += (value - result.mean) * (value - result.mean);
  const auto count = static_cast<double>(finite.size());
  result.error = std::sqrt(squares / (count - 1.0) / count);
  return result;
}

}  // namespace talus
