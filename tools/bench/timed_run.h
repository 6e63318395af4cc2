#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "tools/bench/measure.h"

namespace talus {

/// A run without any observer.
struct TimedRun {
  std::uint64_t end_hash = 0;
  Values values;                      // the timing columns of a row
  std::vector<double> frame_seconds;  // processor time per frame of output
};

/// Runs the scene and takes its time. `seconds` is processor time of this thread: what else the machine does lengthens
/// `wall_seconds` only. The first step is left out: in it the engine allocates.
template <int Dim>
TimedRun timed_run(const Scene<Dim>& scene, const std::string& backend);

}  // namespace talus
