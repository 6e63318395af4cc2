#include "common/measure/ensemble.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "common/math/random.h"

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

EnsembleSummary summarize(std::span<const double> values, int resamples, std::uint64_t seed) {
  if (values.empty()) throw std::invalid_argument("ensemble: must hold at least one run");
  EnsembleSummary summary;
  summary.runs = static_cast<int>(values.size());
  summary.mean = summary.lower = summary.upper = mean(values);
  if (values.size() < 2) return summary;
  double squares = 0.0;
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  summary.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));

  std::mt19937_64 random(seed);
  std::vector<double> means;
  means.reserve(resamples);
  for (int k = 0; k < resamples; ++k) {
    double sum = 0.0;
    for (std::size_t draw = 0; draw < values.size(); ++draw) {
      const auto run = static_cast<std::size_t>(uniform(random) * static_cast<double>(values.size()));
      sum += values[run];
    }
    means.push_back(sum / static_cast<double>(values.size()));
  }
  summary.lower = quantile(means, 0.025);
  summary.upper = quantile(means, 0.975);
  return summary;
}

}  // namespace talus
