#pragma once
// The slope that a pile takes by itself.

#include <numbers>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// That of a pile of which nothing is known yet [rad].
inline constexpr double usual_slope = std::numbers::pi / 6.0;

/// Nothing steeper is measured [rad].
inline constexpr double steepest_slope = 75.0 * std::numbers::pi / 180.0;

/// Slope [rad] of the cone (2D: wedge) that bodies fill evenly whose median distance from its axis and mean height
/// above its base are those of `places`, given relative to the middle of the base [m]: a cone of radius r and height h
/// holds half of its volume within r / 2 and has its centre of mass at h / 4; a wedge within (1 - sqrt(1/2)) r, and at
/// h / 3. The median, since a few bodies roll away; between 5 and 75 degrees. `places` must not be empty; its order is
/// lost.
template <int Dim>
double natural_slope(std::vector<Vec<Dim>>& places);

}  // namespace talus
