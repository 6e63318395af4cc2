#pragma once

#include <optional>

#include "common/pile/boundary.h"

namespace talus {

/// A pile to be built. Constants default to the paper's; where the paper gives none, the reason stands here.
template <int Dim>
struct PileParams {
  std::optional<double> alpha;  // slope [rad] in (0, pi/2); not given: the slope that the bodies take by themselves,
                                // found as they come. Far above it the paper's rule lets few bodies sleep
  bool hold_slope = false;      // whether `adaptive` holds the pile to `alpha`, then given, above what its bodies take
                                // by themselves: bodies lose motion for it, and a pile so held sinks once it is woken
  std::optional<Vec<Dim>> at;   // middle of the base [m]; not given: where the first body lands (section 3.1)
  double initial_size = 8.0;    // N at the start, >= 1; larger: the first bodies wait longer for a dense layer
  double growth_ratio = 0.5;    // occupation ratio above which N doubles (section 3.2), in (0, 1]
  double merge_distance = 1.0;  // [D] >= 0: piles of one kind merge whose centres stay nearer than this; 0: never
  std::optional<Boundary<Dim>> boundary = {};  // walls around `at`, which must then be given; such a pile never drifts
  std::optional<bool> count_flying =
      {};                   // whether bodies that touched nothing yet count; not given: with `adaptive` no,
                            // else yes (section 3.2 counts all). Counted, a stream fills the top layer
  double drift_rate = 0.5;  // [1/s] >= 0: share of the way to the bodies' mean that the centre goes per second
};

}  // namespace talus
