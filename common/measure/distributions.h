#pragma once
// Whether two piles have the same distribution of heights or radii.

#include <span>

namespace talus {

/// How far two distributions F and G lie apart; all three are 0 for equal ones.
struct DistributionDistance {
  double kolmogorov_smirnov = 0.0;  // largest |F - G|, in [0, 1]
  double wasserstein = 0.0;         // W1: integral of |F - G|, in the samples' unit
  double energy = 0.0;              // 2 E|X-Y| - E|X-X'| - E|Y-Y'| = 2 integral (F - G)^2, in the samples' unit
};

/// Distances between two sets of finite numbers, each not empty; throws std::invalid_argument.
DistributionDistance distribution_distance(std::span<const double> a, std::span<const double> b);

}  // namespace talus
