#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/math/random.h"
#include "common/measure/distributions.h"
#include "common/measure/ensemble.h"

namespace talus::measure_distributions_test {
namespace {

TEST(DistributionDistance, OfShiftedSamplesIsTheShift) {
  const std::vector<double> a = {0.0, 1.0, 2.0, 3.0};
  const std::vector<double> b = {0.5, 1.5, 2.5, 3.5};
  const DistributionDistance distance = distribution_distance(a, b);
  EXPECT_DOUBLE_EQ(distance.wasserstein, 0.5);
  EXPECT_DOUBLE_EQ(distance.kolmogorov_smirnov, 0.25);
  EXPECT_DOUBLE_EQ(distance.energy, 2.0 * 0.25 * 0.25 * 2.0) << "gap 1/4 over a length of 4 x 0.5";
}

TEST(DistributionDistance, OfSeparateSamplesIsWhole) {
  const DistributionDistance distance = distribution_distance(std::vector<double>{0.0, 0.0}, std::vector<double>{3.0});
  EXPECT_DOUBLE_EQ(distance.kolmogorov_smirnov, 1.0);
  EXPECT_DOUBLE_EQ(distance.wasserstein, 3.0);
  EXPECT_DOUBLE_EQ(distance.energy, 6.0) << "2 E|X-Y| with nothing to subtract";
}

TEST(DistributionDistance, EnergyEqualsItsDefinitionByPairs) {
  std::mt19937_64 random(9);
  std::vector<std::vector<double>> runs(2);
  for (std::size_t i = 0; i < 40; ++i) {
    runs[0].push_back(uniform(random));
    runs[1].push_back(0.2 + uniform(random));
  }
  const auto mean_gap = [](const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0.0;
    for (const double p : x)
      for (const double q : y) sum += std::abs(p - q);
    return sum / static_cast<double>(x.size() * y.size());
  };
  const double by_pairs = 2.0 * mean_gap(runs[0], runs[1]) - mean_gap(runs[0], runs[0]) - mean_gap(runs[1], runs[1]);
  EXPECT_NEAR(distribution_distance(runs[0], runs[1]).energy, by_pairs, 1e-12);
}

TEST(DistributionDistance, IsZeroForTiedEqualSamples) {
  const std::vector<double> a = {1.0, 1.0, 2.0};
  EXPECT_EQ(distribution_distance(a, a).kolmogorov_smirnov, 0.0);
  EXPECT_EQ(distribution_distance(a, a).wasserstein, 0.0);
}

TEST(MeanWithError, HasTheStandardErrorOfTheMean) {
  const MeanWithError summary = mean_with_error(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(summary.mean, 5.0);
  EXPECT_DOUBLE_EQ(summary.error, std::sqrt(32.0 / 7 / 8));
}

TEST(MeanWithError, LeavesOutWhatIsNotANumberAndHasNoErrorForOne) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mean_with_error(std::vector<double>{3.0, none}).mean, 3.0);
  EXPECT_TRUE(std::isnan(mean_with_error(std::vector<double>{3.0, none}).error));
  EXPECT_TRUE(std::isnan(mean_with_error(std::vector<double>{none}).mean));
}

TEST(Quantile, IsTheSmallestNumberThatEnoughDoNotExceed) {
  std::vector<double> twenty(20);
  for (std::size_t i = 0; i < 20; ++i) twenty[i] = static_cast<double>(20 - i);
  EXPECT_EQ(quantile(twenty, 0.95), 19.0);
  EXPECT_EQ(quantile(twenty, 0.5), 10.0);
  EXPECT_EQ(quantile(twenty, 1.0), 20.0);
  EXPECT_EQ(quantile(twenty, 0.0), 1.0);
}

}  // namespace
}  // namespace talus::measure_distributions_test
