#pragma once
// Whether sleeping changed the motion, before chaotic divergence dominates: continuations of the same state, compared
// for a second.

#include <span>
#include <vector>

#include "common/measure/fork.h"

namespace talus {

/// Differences of two continuations after `frames` frames.
struct HorizonError {
  int frames = 0;
  int forks = 0;           // that both continuations followed so far
  double ratio = 0.0;      // R of motion_errors(), mean over the frames up to here and the forks
  double symmetric = 0.0;  // S, of the same bodies
  double mean = 0.0;       // distance between a body's two places over its D, over all bodies of all forks
  double p95 = 0.0;
  double max = 0.0;
};

/// Compares the continuations `full` and `other` of each fork after 10, 20 and 30 frames, over the bodies that were
/// there at the fork. `extents` holds D [m] per shape, `gravity` in m/s^2. One entry per horizon.
///
/// A piled run: `full` at the reference settings with all bodies awake, `other` the run itself. Its floors: the same
/// with a full run's recording (what losing the engine's memory of the last step costs), and two full continuations of
/// which one is nudged (chaos).
template <int Dim>
std::vector<HorizonError> horizon_errors(std::span<const Fork<Dim>> forks, std::span<const Arrival<Dim>> arrivals,
                                         const Continuation<Dim>& full, const Continuation<Dim>& other,
                                         std::span<const double> extents, double gravity,
                                         std::vector<int> horizons = {10, 20, 30});

}  // namespace talus
