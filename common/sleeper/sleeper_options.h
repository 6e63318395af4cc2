#pragma once

#include <optional>

#include "common/policy/rest/adaptive_params.h"
#include "common/sleeper/up_axis.h"

namespace talus {

/// How a sleeper works. The defaults fit piles of any size in any gravity.
struct SleeperOptions {
  /// Whether bodies sleep at all. Without it, a sleeper changes nothing and the engine gives the bits that it gives
  /// alone.
  bool enabled = true;
  /// The direction that is up. Empty: the axis nearest to the opposite of gravity.
  std::optional<UpAxis> up = {};
  /// D [m] > 0, the extent of the typical body: the diagonal of its box, in which the policy measures lengths. Empty:
  /// that of the bodies added, without the largest fiftieth of them.
  std::optional<double> extent = {};
  /// Of the policy, as in a scene, but for two. `rings` must be 0, since the foreign engine solves the contacts.
  /// `tolerance` is 0: no stability checks, which keep a heap awake for long where an engine's contacts creep. With
  /// them, 0.05 in a scene, heaps are flatter and cost more.
  AdaptiveParams adaptive = {.tolerance = 0.0};
};

}  // namespace talus
