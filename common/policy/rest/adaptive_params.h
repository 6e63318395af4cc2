#pragma once

#include <algorithm>

#include "common/math/angle.h"
#include "common/world/sleep_ring.h"

namespace talus {

/// Rings of a scene that names none, under small steps (lab/notes/ring.md).
inline constexpr int usual_rings = SleepRing{}.rings;

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
  double avalanche_angle = in_radians(25.0);
  int rings = 0;
  double ring_still_speed = SleepRing{}.still_speed;

  /// Factor of the rest distances: a tolerance below the default is kept while a pour goes on, too, when there are few
  /// checks (lab/notes/tolerance_in_a_pour.md). 1 without a tolerance.
  double rest_distance_factor() const;
  /// Share of a region's sleeping bodies that must be unchecked before the region is checked while it moves. Above 1
  /// such a check never begins.
  double loaded_share() const { return 10.0 * tolerance; }
};

inline double AdaptiveParams::rest_distance_factor() const {
  return tolerance > 0.0 ? std::min(1.0, tolerance / AdaptiveParams{}.tolerance) : 1.0;
}

}  // namespace talus
