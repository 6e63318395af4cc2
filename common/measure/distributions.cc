#include "common/measure/distributions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "common/math/random.h"

namespace talus {
namespace {

/// All numbers of all runs in rising order, each with the run it came from.
struct PooledSample {
  double value;
  std::size_t run;
};

std::vector<PooledSample> pool(const RunSamples& runs) {
  std::vector<PooledSample> pooled;
  for (std::size_t run = 0; run < runs.size(); ++run)
    for (const double value : runs[run]) pooled.push_back({value, run});
  std::stable_sort(pooled.begin(), pooled.end(), [](const auto& x, const auto& y) { return x.value < y.value; });
  return pooled;
}

/// Walks up both distribution functions at once; `in_a` gives for each run its side.
DistributionDistance distance(std::span<const PooledSample> pooled, std::span<const std::uint8_t> in_a,
                              std::span<const std::size_t> sizes) {
  double size_a = 0.0;
  double size_b = 0.0;
  for (std::size_t run = 0; run < sizes.size(); ++run)
    (in_a[run] != 0 ? size_a : size_b) += static_cast<double>(sizes[run]);
  DistributionDistance result;
  double count_a = 0.0;
  double count_b = 0.0;
  for (std::size_t i = 0; i < pooled.size(); ++i) {
    (in_a[pooled[i].run] != 0 ? count_a : count_b) += 1.0;
    if (i + 1 == pooled.size() || pooled[i + 1].value == pooled[i].value) continue;
    const double gap = std::abs(count_a / size_a - count_b / size_b);
    const double width = pooled[i + 1].value - pooled[i].value;
    result.kolmogorov_smirnov = std::max(result.kolmogorov_smirnov, gap);
    result.wasserstein += gap * width;
    result.energy += 2.0 * gap * gap * width;
  }
  return result;
}

/// How many permutations gave a distance at least as large as the one observed.
class Exceedances {
 public:
  explicit Exceedances(const DistributionDistance& observed) : observed_(observed) {}
  void add(const DistributionDistance& permuted) {
    // The same split in another order rounds differently; it must count as equal.
    constexpr double slack = 1.0 - 1e-9;
    ++tried_;
    count_.kolmogorov_smirnov += permuted.kolmogorov_smirnov >= slack * observed_.kolmogorov_smirnov;
    count_.wasserstein += permuted.wasserstein >= slack * observed_.wasserstein;
    count_.energy += permuted.energy >= slack * observed_.energy;
  }
  DistributionDistance share() const {
    const double n = tried_;
    return {count_.kolmogorov_smirnov / n, count_.wasserstein / n, count_.energy / n};
  }
  int tried() const { return tried_; }

 private:
  DistributionDistance observed_;
  DistributionDistance count_;
  int tried_ = 0;
};

/// Fisher and Yates.
void shuffle(std::vector<std::uint8_t>& values, std::mt19937_64& random) {
  for (std::size_t left = values.size(); left > 1; --left) {
    const auto chosen = static_cast<std::size_t>(uniform(random) * static_cast<double>(left));
    std::swap(values[left - 1], values[chosen]);
  }
}

/// Ways to choose `chosen` of `total`, or a number above `limit`.
double ways(std::size_t total, std::size_t chosen, double limit) {
  double result = 1.0;
  for (std::size_t k = 1; k <= chosen && result <= limit; ++k)
    result = result * static_cast<double>(total - chosen + k) / static_cast<double>(k);
  return result;
}

void check_runs(const RunSamples& runs) {
  if (runs.empty()) throw std::invalid_argument("ensemble: must hold at least one run");
  for (const auto& run : runs) {
    if (run.empty()) throw std::invalid_argument("run of an ensemble: must hold at least one number");
    for (const double value : run)
      if (!std::isfinite(value)) throw std::invalid_argument("run of an ensemble: numbers must be finite");
  }
}

}  // namespace

DistributionTest test_distributions(const RunSamples& a, const RunSamples& b, const PermutationParams& params) {
  check_runs(a);
  check_runs(b);
  RunSamples runs = a;
  runs.insert(runs.end(), b.begin(), b.end());
  const std::vector<PooledSample> pooled = pool(runs);
  std::vector<std::size_t> sizes;
  sizes.reserve(runs.size());
  for (const auto& run : runs) sizes.push_back(run.size());
  std::vector<std::uint8_t> in_a(runs.size(), 0);
  std::fill_n(in_a.begin(), a.size(), std::uint8_t{1});

  DistributionTest test;
  test.distance = distance(pooled, in_a, sizes);
  test.exhaustive = ways(runs.size(), a.size(), params.most) <= params.most;
  Exceedances exceedances(test.distance);
  exceedances.add(test.distance);  // the split as it is: always one of the ways
  if (test.exhaustive) {
    while (std::prev_permutation(in_a.begin(), in_a.end())) exceedances.add(distance(pooled, in_a, sizes));
  } else {
    std::mt19937_64 random(params.seed);
    while (exceedances.tried() < params.most) {
      shuffle(in_a, random);
      exceedances.add(distance(pooled, in_a, sizes));
    }
  }
  test.p = exceedances.share();
  test.permutations = exceedances.tried();
  return test;
}

DistributionDistance distribution_distance(std::span<const double> a, std::span<const double> b) {
  const RunSamples runs = {{a.begin(), a.end()}, {b.begin(), b.end()}};
  check_runs(runs);
  return distance(pool(runs), std::vector<std::uint8_t>{1, 0}, std::vector<std::size_t>{a.size(), b.size()});
}

}  // namespace talus
