#pragma once
// Units of time and speed of a body of extent D [m] in a gravity g [m/s^2].

#include <algorithm>
#include <cmath>

namespace talus {

/// Less gravity counts as this [m/s^2]: nothing slides in it.
inline constexpr double least_gravity = 0.01;

/// sqrt(D/g) [s], the time in which a body falls by D/2: the unit of the times of rules.
inline double time_unit(double extent, double gravity) { return std::sqrt(extent / std::max(gravity, least_gravity)); }

/// sqrt(g D) [m/s].
inline double speed_unit(double extent, double gravity) { return std::sqrt(std::max(gravity, least_gravity) * extent); }

}  // namespace talus
