#pragma once
// What differs between a cone (3D) and a wedge (2D), and nothing else.

#include <cmath>
#include <numbers>

#include "common/math/vector.h"

namespace talus {

/// A pile without walls: a disc (in 2D an interval) of radius r at the base, shrinking to a point at height r
/// tan(alpha).
template <int Dim>
struct Profile;

/// Cone. Equation (1): N v_obj = (pi/3) r^3 tan(alpha).
template <>
struct Profile<3> {
  static double base_radius(double volume, double alpha) {
    return std::cbrt(3.0 * volume / (std::numbers::pi * std::tan(alpha)));
  }
  /// Area of the base.
  static double base_area(double radius) { return std::numbers::pi * radius * radius; }
};

/// Wedge, equation (1)'s twin with areas: N v_obj = r^2 tan(alpha).
template <>
struct Profile<2> {
  static double base_radius(double volume, double alpha) { return std::sqrt(volume / std::tan(alpha)); }
  /// Length of the base.
  static double base_area(double radius) { return 2.0 * radius; }
};

/// Volume of what tapers evenly from a base of area `base` to a point at height `rise`: cone, pyramid, wedge.
template <int Dim>
double tip_volume(double base, double rise) {
  return base * rise / Dim;
}

}  // namespace talus
