#pragma once
// How far will a pile move once all of its bodies wake? Seen from the beginning of that motion.

#include <cstdint>
#include <functional>
#include <span>

#include "common/measure/rebuild.h"

namespace talus {

struct DriftProbeParams {
  double extent = 1.0;      // D [m] > 0
  double unit = 0.4;        // sqrt(D/g) [s] > 0, the time in which motion of a pile dies out or becomes visible
  double duration = 5.0;    // [s] > 0 of the wake test whose result is foreseen
  double body_steps = 1e6;  // most steps times bodies; fewer than a shortest probe needs: no result
  /// Called before each step; where it returns true the probe ends there, without a result. Empty: never.
  std::function<bool()> stop = {};
};

/// Mean displacement of the bodies that count [D].
struct DriftProbe {
  int bodies = 0;        // that count; 0: no result
  double seconds = 0.0;  // simulated
  double least = 0.0;    // displacement by then
  double most = 0.0;     // at the end of the wake test, should the motion go on at its present speed

  /// The motion of a pile at rest dies out, that of a sliding one does not: the middle of the two.
  double expected() const { return 0.5 * (least + most); }
};

/// Rebuilds `states` in a fresh world with all bodies awake and simulates until `most` is at most three times `least`,
/// so that a drift between the two is within a factor of 2 of expected(), and at least 1.2, at most 5 units of time.
/// What fails later is not seen. `description` holds the settings to judge by, as judging_settings() gives them. Only
/// bodies with a 1 in `counted` (by body) count. The measure foreseen is wake_test(); lab/notes/drift_probe.md has
/// how well.
template <int Dim>
DriftProbe probe_drift(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                       const BodyStates<Dim>& states, std::span<const std::uint8_t> counted,
                       const DriftProbeParams& params);

}  // namespace talus
