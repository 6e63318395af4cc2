#pragma once
// A number per run, summed up over the runs of an ensemble.

#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// Mean, standard deviation and confidence interval of the mean.
struct EnsembleSummary {
  int runs = 0;
  double mean = 0.0;
  double deviation = 0.0;  // standard deviation of one run (n - 1)
  double lower = 0.0;      // 95 % interval of the mean, by bootstrap over runs
  double upper = 0.0;
};

/// `resamples` >= 1 bootstrap draws of as many runs, percentiles 2.5 and 97.5 of their means. One run alone has no
/// interval: lower = upper = mean. Throws std::invalid_argument on no runs.
EnsembleSummary summarize(std::span<const double> values, int resamples = 4000, std::uint64_t seed = 1);

/// The smallest of the numbers that a share `q` in [0, 1] of them does not exceed; 0 for no numbers.
double quantile(std::vector<double> values, double q);

/// The middle number, of an even count the mean of the two in the middle; 0 for no numbers.
double median(std::vector<double> values);

/// Mean of the numbers, 0 for none.
double mean(std::span<const double> values);

}  // namespace talus
