#pragma once

#include <numbers>

namespace talus {

/// Constants of the policy `adaptive`. Lengths in D, the typical body's extent, so that they hold at any scale.
struct AdaptiveParams {
  double rest_distance = 0.01;   // [D] > 0: a body is at rest while no point of it strays farther. Large: bodies that
                                 // topple slowly are caught on edge; small: solver noise keeps the pile awake
  double rest_time_deep = 0.06;  // [s] >= 0, at rest before sleep where the score is highest
  double rest_time_surface = 0.14;     // [s] >= rest_time_deep, where it is zero. Short: a peak too high; long: slow
  double rest_distance_woken = 0.002;  // [D] > 0: who woke and strayed no farther may sleep after ...
  double rest_time_woken = 0.05;       // [s] >= 0 ... this time. A slide has hardly begun by then: far or short catch
                                       // it; near or long keep much awake for nothing
  double wake_height = 0.03;  // [D] > 0: a blow wakes whom it gives, where it strikes, the speed to rise by this. Low:
                              // much is awake for nothing; high: blows end as on rock, and the pile stays too steep
  double heavy_blow = 20.0;   // > 0: bodies that a blow must be able to move at once to wake them before it lands. Low:
                              // each drop wakes a heap; high: what is heavy and fast is stopped as by a rock
  double support_slack = 0.01;     // [D] > 0: how far a bearer may move before what it bears wakes. Large: bodies hang
  double awake_share = 0.25;       // in [0, 1): part of a body's weight that awake bodies may bear when it falls asleep
  double avalanche_width = 4.0;    // [D] > 0 of a column. Narrow: heaps do not slide as a whole; wide: much is awake
  double avalanche_growth = 1.15;  // > 1: growth of a column of sleepers until it may slide. Large: heaps too steep;
                                   // small: much is awake for nothing; 1000 in effect never
  double avalanche_growth_quiet = 1.0;  // >= 1: the same while no awake body touches another; 1: any. Large: piles come
                                        // to rest too steep; 1000 in effect never
  double avalanche_angle = 25.0 * std::numbers::pi / 180.0;  // [rad] in [0, pi/2): slope between columns from which
                                                             // they may slide. Low: plains wake; high: heaps too steep
  double steering_gain = 20.0;   // [sqrt(g / D) / rad] >= 0: drag on bodies that touch something in a pile held to a
                                 // slope, per slope missing. Low: late; high: a thin tower on a broad foot
  double steering_growth = 0.3;  // [g / D / rad] >= 0: what it grows by in a second. Low: too flat; high: waves
  double steering_most = 4.0;    // [sqrt(g / D)] >= 0: such drag at most. Low: too flat; high: bodies stick anywhere
};

}  // namespace talus
