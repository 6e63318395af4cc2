#pragma once
// A number per run, summed up over the runs of an ensemble.

#include <limits>
#include <span>
#include <vector>

namespace talus {

struct MeanWithError {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();  // standard error of the mean
};

/// Of the numbers that are finite. NaN for the mean of none, and for the error of fewer than two.
MeanWithError mean_with_error(std::span<const double> values);

/// The smallest of the numbers that a share `q` in [0, 1] of them does not exceed; 0 for no numbers.
double quantile(std::vector<double> values, double q);

/// The middle number, of an even count the mean of the two in the middle; 0 for no numbers.
double median(std::vector<double> values);

/// Mean of the numbers, 0 for none.
double mean(std::span<const double> values);

}  // namespace talus
