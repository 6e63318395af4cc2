#pragma once
// The slope that a pile takes by itself.

#include <cstddef>
#include <numbers>
#include <vector>

#include "common/math/angle.h"
#include "common/math/vector.h"

namespace talus {

/// Slope of a pile before its own can be measured [rad].
inline constexpr double default_angle_of_repose = std::numbers::pi / 6.0;

/// A flatter layer is no pile [rad].
inline constexpr double min_angle_of_repose = in_radians(5.0);

/// Largest slope that is ever measured [rad].
inline constexpr double max_angle_of_repose = in_radians(75.0);

/// Least number of bodies whose slope means something. Chosen, not measured.
inline constexpr std::size_t min_bodies_for_slope = 16;

/// Slope [rad] of the cone (2D: wedge), evenly filled with bodies, that has the same median distance from the axis and
/// the same mean height above the base as `positions`, which are relative to the middle of the base [m]. A cone of
/// radius r and height h holds half of its volume within r / 2 and has its centre of mass at h / 4; a wedge within
/// (1 - sqrt(1/2)) r and at h / 3. The median is used since a few bodies roll away. The result lies between 5 and 75
/// degrees. `positions` must not be empty; their order is lost.
template <int Dim>
double estimate_angle_of_repose(std::vector<Vec<Dim>>& positions);

}  // namespace talus
