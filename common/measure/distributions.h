#pragma once
// Whether two ensembles of runs have the same distribution of heights or radii.

#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// One entry per run: a number per body, such as its height z or its radius r.
using RunSamples = std::vector<std::vector<double>>;

/// How far two distributions F and G lie apart; all three are 0 for equal ones.
struct DistributionDistance {
  double kolmogorov_smirnov = 0.0;  // largest |F - G|, in [0, 1]
  double wasserstein = 0.0;         // W1: integral of |F - G|, in the samples' unit
  double energy = 0.0;              // 2 E|X-Y| - E|X-X'| - E|Y-Y'| = 2 integral (F - G)^2, in the samples' unit
};

/// Distances between two sets of numbers, each not empty; throws std::invalid_argument.
DistributionDistance distribution_distance(std::span<const double> a, std::span<const double> b);

struct PermutationParams {
  int most = 20000;        // permutations; if there are no more ways than these, all are tried. Few: p is coarse
  std::uint64_t seed = 1;  // of the random permutations
};

/// Distances between two ensembles, bodies pooled in runs, and for each the probability p of one as large or larger if
/// both ensembles came from the same distribution of runs.
struct DistributionTest {
  DistributionDistance distance;
  DistributionDistance p;
  int permutations = 0;
  bool exhaustive = false;
};

/// Tests by permuting whole runs between the ensembles: bodies of one run depend on one another, so permuting bodies
/// would call chance a difference. With K runs a side the smallest p is 2 / (2K choose K): 0.00016 at K = 8, 0.1 at K
/// = 3. Throws std::invalid_argument if an ensemble or a run is empty.
DistributionTest test_distributions(const RunSamples& a, const RunSamples& b, const PermutationParams& params = {});

}  // namespace talus
