#pragma once

#include <numbers>

namespace talus {

/// Parameters of the policy `adaptive`. Lengths are in D, the typical body's extent, so that they hold at any scale.
/// docs/method.md explains the rules, docs/research/ how the values were found.
struct AdaptiveParams {
  /// [D] > 0. A body is at rest while no point of it moves farther. Large: bodies that topple slowly fall asleep on
  /// edge; small: solver noise keeps the pile awake.
  double rest_distance = 0.01;

  /// [s] >= 0. Time at rest before sleep where the score is 1, deep in the pile.
  double rest_time_deep = 0.06;

  /// [s] >= rest_time_deep. The same where the score is 0, at the surface. Short: the peak becomes too high; long:
  /// slow.
  double rest_time_surface = 0.14;

  /// [D] > 0. A woken body that has moved no farther after `rest_time_woken` may sleep again. Large: slides are stopped
  /// as they begin; small: much stays awake for nothing.
  double rest_distance_woken = 0.002;

  /// [s] >= 0. Short: slow slides are stopped; long: much stays awake for nothing.
  double rest_time_woken = 0.05;

  /// [D] > 0. An impact wakes a body if it would give the struck point enough speed to rise by this height. Low: much
  /// wakes for nothing; high: impacts end as on rock, and the pile stays too steep.
  double wake_height = 0.03;

  /// > 0. Number of typical bodies that an impact must be able to move to wake them before it lands. Low: each drop
  /// wakes a heap; high: a heavy fast body is stopped as by rock.
  double heavy_impact = 20.0;

  /// [D] > 0. How far a supporting contact may move before the supported body wakes. Large: bodies hang in the air.
  double support_slack = 0.01;

  /// In [0, 1). Part of a body's weight that awake bodies may carry when it falls asleep.
  double awake_share = 0.25;

  /// [D] > 0. Width of the columns of local avalanches. Narrow: heaps do not slide as a whole; wide: much is awake.
  double avalanche_width = 4.0;

  /// > 1. Growth of a column's sleeping bodies, as a factor, from one check to the next. Large: heaps become too steep;
  /// small: much wakes for nothing; 1000: in effect never.
  double avalanche_growth = 1.15;

  /// >= 1. The same while no awake body touches another; 1: any growth. Large: piles come to rest too steep.
  double avalanche_growth_quiet = 1.0;

  /// [rad] in [0, pi/2). Slope between columns from which they may slide. Low: plains wake; high: heaps become too
  /// steep.
  double avalanche_angle = 25.0 * std::numbers::pi / 180.0;

  /// [sqrt(g / D) / rad] >= 0. Damping per missing slope, in piles with slope control. Low: late; high: a thin tower on
  /// a broad foot.
  double slope_proportional_gain = 20.0;

  /// [g / D / rad] >= 0. Growth of the damping in a second, per missing slope. Low: too flat; high: waves.
  double slope_integral_gain = 0.3;

  /// [sqrt(g / D)] >= 0. Largest damping. Low: too flat; high: bodies stick wherever they touch.
  double slope_max_damping = 4.0;
};

}  // namespace talus
