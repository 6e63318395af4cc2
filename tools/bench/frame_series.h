#pragma once

#include <filesystem>
#include <vector>

#include "tools/bench/bench_case.h"

namespace talus {

/// What a case took and how far it was from the full run, frame by frame of output.
struct FrameSeries {
  double frame_time = 0.0;       // [s]
  std::vector<double> seconds;   // processor time, median of the rounds
  std::vector<double> relative;  // the paper's e; NaN where nothing moved
  std::vector<double> absolute;  // the paper's E over m0
  std::vector<double> ratio;     // R
};

/// Measures it, or reads what an earlier call left as a file in `folder`. The errors of `full` itself are those of its
/// perturbed run.
FrameSeries frame_series(const std::filesystem::path& folder, const BenchCase& bench_case, const BenchCase& full,
                         int rounds);

}  // namespace talus
