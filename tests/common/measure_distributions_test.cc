#include <gtest/gtest.h>

#include "common/math/random.h"
#include "common/measure/distributions.h"
#include "common/measure/ensemble.h"

namespace talus::measure_distributions_test {
namespace {

/// `runs` runs of `bodies` numbers, uniform in [0, 1) plus a shift of each run's own, uniform within `scatter`.
RunSamples ensemble(int runs, int bodies, double shift, double scatter, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  RunSamples samples(static_cast<std::size_t>(runs));
  for (auto& run : samples) {
    const double own = shift + scatter * uniform_both_sides(random);
    for (int i = 0; i < bodies; ++i) run.push_back(own + uniform(random));
  }
  return samples;
}

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
  const RunSamples runs = ensemble(2, 40, 0.0, 0.3, 9);
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

TEST(DistributionTest, TriesAllSplitsWhenFewAndFindsTheSmallestPossibleP) {
  const DistributionTest test = test_distributions(ensemble(4, 20, 0.0, 0.01, 1), ensemble(4, 20, 5.0, 0.01, 2));
  EXPECT_TRUE(test.exhaustive);
  EXPECT_EQ(test.permutations, 70);  // 8 choose 4
  // Only the split as it is and its mirror image are this far apart.
  EXPECT_DOUBLE_EQ(test.p.wasserstein, 2.0 / 70);
  EXPECT_DOUBLE_EQ(test.p.kolmogorov_smirnov, 2.0 / 70);
  EXPECT_DOUBLE_EQ(test.p.energy, 2.0 / 70);
}

TEST(DistributionTest, DoesNotTakeRunsThatScatterForADifference) {
  // Bodies of a run share their run's shift, as bodies of one heap do. Permuting bodies would find p near 0 here. Under
  // equal distributions p is uniform: over 40 trials 4 are expected below 0.1, more than 10 have probability 0.001.
  int below = 0;
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    const auto a = ensemble(4, 50, 0.0, 0.3, 100 + 2 * trial);
    const auto b = ensemble(4, 50, 0.0, 0.3, 101 + 2 * trial);
    below += test_distributions(a, b).p.wasserstein < 0.1;
  }
  EXPECT_LE(below, 10);
}

TEST(DistributionTest, DrawsPermutationsAlikeFromTheSameSeedWhenThereAreMany) {
  const auto a = ensemble(10, 20, 0.0, 0.2, 1);
  const auto b = ensemble(10, 20, 0.3, 0.2, 2);  // 184,756 splits
  const PermutationParams params{.most = 2000, .seed = 4};
  const DistributionTest test = test_distributions(a, b, params);
  EXPECT_FALSE(test.exhaustive);
  EXPECT_EQ(test.permutations, 2000);
  EXPECT_LT(test.p.wasserstein, 0.02);
  EXPECT_EQ(test.p.wasserstein, test_distributions(a, b, params).p.wasserstein);
}

TEST(DistributionTest, RefusesEmptyEnsembles) {
  EXPECT_THROW(test_distributions({}, {{1.0}}), std::invalid_argument);
  EXPECT_THROW(test_distributions({{}}, {{1.0}}), std::invalid_argument);
}

TEST(EnsembleSummary, GivesMeanDeviationAndAnIntervalThatHoldsTheMean) {
  const EnsembleSummary summary = summarize(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(summary.mean, 5.0);
  EXPECT_DOUBLE_EQ(summary.deviation, std::sqrt(32.0 / 7));
  // The mean's standard error is 0.71 by bootstrap: 1.96 of it to both sides, to a tenth.
  EXPECT_NEAR(summary.lower, 5.0 - 1.96 * std::sqrt(32.0 / 8 / 8), 0.15);
  EXPECT_NEAR(summary.upper, 5.0 + 1.96 * std::sqrt(32.0 / 8 / 8), 0.15);
}

TEST(EnsembleSummary, OfOneRunHasNoSpread) {
  const EnsembleSummary summary = summarize(std::vector<double>{3.0});
  EXPECT_EQ(summary.lower, 3.0);
  EXPECT_EQ(summary.upper, 3.0);
  EXPECT_THROW(summarize({}), std::invalid_argument);
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
