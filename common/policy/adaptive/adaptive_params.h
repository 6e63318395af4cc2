#pragma once

#include <algorithm>
#include <array>
#include <numbers>

#include "common/params/field.h"

namespace talus {

/// Parameters of the policy `adaptive`. Lengths are in D, the typical body's extent, and times in sqrt(D/g), the time
/// in which a body falls by D/2, so that they hold at any scale and in any gravity. adaptive_fields has the unit, range
/// and effect of each. docs/method.md explains the rules, lab/notes/ how the values were found.
struct AdaptiveParams {
  double tolerance = 0.05;
  double rest_distance = 0.01;
  double rest_period_deep = 0.16;
  double rest_period_surface = 0.37;
  double rest_distance_woken = 0.002;
  double rest_period_woken = 0.13;
  double wake_height = 0.03;
  double heavy_impact = 20.0;
  double support_slack = 0.01;
  double awake_share = 0.25;
  double avalanche_width = 4.0;
  double avalanche_growth = 1.15;
  double avalanche_angle = 25.0 * std::numbers::pi / 180.0;
  double slope_proportional_gain = 20.0;
  double slope_integral_gain = 0.3;
  double slope_max_damping = 4.0;

  /// Factor of the rest distances: a tolerance below the default is kept while a pour goes on, too, when there are few
  /// checks (lab/notes/tolerance_in_a_pour.md). 1 without a tolerance.
  double rest_distance_factor() const;
  /// Share of a region's sleeping bodies that must be unchecked before the region is checked while it moves. Above 1
  /// such a check never begins.
  double loaded_share() const { return 10.0 * tolerance; }
};

inline constexpr auto adaptive_fields = std::to_array<Field<AdaptiveParams>>({
    {&AdaptiveParams::tolerance,
     {.name = "tolerance",
      .unit = "D",
      .range = between(0.0, 10.0),
      .meaning =
          "mean distance that the bodies of a region at rest may still move when all of them wake. Each region is "
          "checked for it when it comes to rest; one that moves and is steeper than its friction holds, when 10 times "
          "this share of it is unchecked; below 0.05 both rest distances shrink in proportion. Large: heaps come "
          "to rest too steep; small: checks take long and more is awake; 0: no checks"}},
    {&AdaptiveParams::rest_distance,
     {.name = "rest_distance",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning =
          "a body is at rest while no point of it moves farther. Large: bodies that topple slowly fall asleep on "
          "edge; small: solver noise keeps the pile awake"}},
    {&AdaptiveParams::rest_period_deep,
     {.name = "rest_period_deep",
      .unit = "sqrt(D/g)",
      .range = between(0.0, 1e3),
      .meaning = "time at rest before sleep where the score is 1: deep in the pile, where layers are dense and the "
                 "centre is near"}},
    {&AdaptiveParams::rest_period_surface,
     {.name = "rest_period_surface",
      .unit = "sqrt(D/g)",
      .range = between(0.0, 1e3),
      .not_below = "rest_period_deep",
      .meaning =
          "the same where the score is 0: at the surface and outside the pile. Short: the peak becomes too high; "
          "long: slow"}},
    {&AdaptiveParams::rest_distance_woken,
     {.name = "rest_distance_woken",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning = "a woken body that has moved no farther after `rest_period_woken` may sleep again. Large: slides are "
                 "stopped as they begin; small: much stays awake for nothing"}},
    {&AdaptiveParams::rest_period_woken,
     {.name = "rest_period_woken",
      .unit = "sqrt(D/g)",
      .range = between(0.0, 1e3),
      .meaning = "that time. Short: slow slides are stopped; long: much stays awake for nothing"}},
    {&AdaptiveParams::wake_height,
     {.name = "wake_height",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning = "an impact wakes a body if it would give the struck point enough speed to rise by this height; an "
                 "impact from straight above counts by a third. Low: much wakes for nothing; high: impacts end as on "
                 "rock, and the pile stays too steep"}},
    {&AdaptiveParams::heavy_impact,
     {.name = "heavy_impact",
      .old_name = "heavy_blow",
      .unit = "bodies",
      .range = above(0.0, 1e9),
      .meaning = "number of typical bodies that an impact must be able to move to wake them before it lands. Low: each "
                 "drop wakes a heap; high: a heavy fast body is stopped as by rock"}},
    {&AdaptiveParams::support_slack,
     {.name = "support_slack",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning =
          "how far a supporting contact may move before the supported body wakes. Large: bodies hang in the air"}},
    {&AdaptiveParams::awake_share,
     {.name = "awake_share",
      .range = below(1.0),
      .meaning = "part of a body's weight that awake bodies may carry when it falls asleep"}},
    {&AdaptiveParams::avalanche_width,
     {.name = "avalanche_width",
      .unit = "D",
      .range = above(0.0, 1e3),
      .meaning =
          "width of the columns of local avalanches. Narrow: heaps do not slide as a whole; wide: much is awake"}},
    {&AdaptiveParams::avalanche_growth,
     {.name = "avalanche_growth",
      .range = above(1.0, 1e3),
      .meaning = "growth of a column's sleeping bodies, as a factor, from one check to the next, from which the column "
                 "may slide. Large: heaps become too steep; small: much wakes for nothing; 1000: in effect never"}},
    {&AdaptiveParams::avalanche_angle,
     {.name = "avalanche_angle_deg",
      .unit = "degrees",
      .stored = Stored::in_radians,
      .range = between(0.0, 89.0),
      .meaning = "slope from the top of one column to the top of the next from which bodies may slide. Low: plains "
                 "wake; high: heaps become too steep"}},
    {&AdaptiveParams::slope_proportional_gain,
     {.name = "slope_proportional_gain",
      .old_name = "steering_gain",
      .unit = "sqrt(g/D)",
      .range = between(0.0, 1e6),
      .meaning =
          "in a pile with `control_slope`: damping of bodies in contact, per radian of missing slope. Low: late; "
          "high: a thin tower on a broad foot"}},
    {&AdaptiveParams::slope_integral_gain,
     {.name = "slope_integral_gain",
      .old_name = "steering_growth",
      .unit = "g/D",
      .range = between(0.0, 1e6),
      .meaning = "growth of that damping in a second, per radian of missing slope. Low: piles too flat; high: waves"}},
    {&AdaptiveParams::slope_max_damping,
     {.name = "slope_max_damping",
      .old_name = "steering_most",
      .unit = "sqrt(g/D)",
      .range = between(0.0, 1e6),
      .meaning = "the largest damping. Low: piles too flat; high: bodies stick wherever they touch"}},
});

inline double AdaptiveParams::rest_distance_factor() const {
  return tolerance > 0.0 ? std::min(1.0, tolerance / AdaptiveParams{}.tolerance) : 1.0;
}

}  // namespace talus
