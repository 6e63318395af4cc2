#pragma once

#include <algorithm>
#include <cmath>

namespace talus {

/// Less gravity counts as this [m/s^2]: nothing slides in it.
inline constexpr double least_gravity = 0.01;

/// Which sleeping bodies take part in the contact solve, and what wakes them. See Ring.
struct SleepRing {
  double extent = 1.0;        // D, that of the typical body [m]
  int rings = 2;              // contacts between a sleeping body and what moves, at most
  double still_speed = 0.01;  // faster sleeping bodies count as moving [speed_unit()]

  /// sqrt(g D) [m/s], and a little without gravity: else no body would count as still there.
  double speed_unit(double gravity) const { return std::sqrt(std::max(gravity, least_gravity) * extent); }
};

}  // namespace talus
