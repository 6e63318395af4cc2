#pragma once
// Published experiments and our runs of them as a page.

#include <string>
#include <vector>

#include "common/measure/ensemble.h"
#include "tools/bench/bench_run.h"
#include "tools/bench/experiment.h"

namespace talus {

/// A run of an experiment.
struct PublishedRun {
  const Experiment* experiment = nullptr;
  std::size_t row = 0;
  BenchCase run = {};
  std::size_t same_as = 0;            // number of the first run with this case, which is simulated for all of them
  double value = BenchNumbers::none;  // as published, divided and counted; NaN: not measured
  double seconds = 0.0;               // wall time of the steps
  std::string failure = {};
};

/// How far a mean is from what was published.
struct Difference {
  double value = BenchNumbers::none;  // 0 within a published interval; NaN where nothing was published or measured
  bool agrees = false;                // within two standard errors of both
};
Difference difference(const MeanWithError& ours, const Published& published);

/// Mean of values; the error of a share is that of one success and one failure more, so that it is never 0.
MeanWithError mean_of(const std::vector<double>& values, bool share);

/// A page in Markdown, a table for each experiment, with a line for each setting, fit and engine and columns for each
/// policy.
std::string published_page(const std::vector<PublishedRun>& runs, const std::vector<std::string>& policies);

}  // namespace talus
