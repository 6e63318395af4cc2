#pragma once
// Runs of a sweep on this machine.

#include <vector>

#include "tools/sweep/sweep_folder.h"

namespace talus {

/// What became of the runs.
struct SweepEnd {
  int failed = 0;
  bool interrupted = false;  // by a signal
};

/// The numbers of the runs that are not finished.
std::vector<int> unfinished(const Sweep& sweep);

/// Does the runs of these numbers, up to `jobs` at a time, with a line on standard error for each. A run that has ended
/// gets its folder in one step, so a folder of a run is never half-written. Under a lock. Throws std::invalid_argument
/// where the scene is no longer that of the sweep.
SweepEnd do_runs(const Sweep& sweep, const std::vector<int>& numbers, int jobs);

}  // namespace talus
