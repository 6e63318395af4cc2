#pragma once
// What the runs of a sweep gave, gathered from their folders.

#include "tools/sweep/sweep_folder.h"

namespace talus {

struct SweepCount {
  int runs = 0;
  int finished = 0;
  int failed = 0;
  int begun = 0;
  int with_warnings = 0;
  bool lacks_plotted = false;  // no finished run has the number to plot
  int waiting() const { return runs - finished - failed - begun; }
};

/// Counts, and prints on standard error the runs that failed, with the end of their messages.
SweepCount count_runs(const Sweep& sweep);

/// The same, and writes sweep.csv and where it can sweep.svg; also tells of runs that began and did not end. Prints
/// progress and the result. One run is in memory at a time.
SweepCount collect(const Sweep& sweep);

}  // namespace talus
