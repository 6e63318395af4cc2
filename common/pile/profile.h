#pragma once
// What differs between a cone (3D) and a wedge (2D), and nothing else.

#include <cmath>
#include <numbers>

#include "common/math/vector.h"

namespace talus {

/// Outline of a pile of slope `alpha` [rad]: at height z above its base a slice of half-width r = r_base - z /
/// tan(alpha).
template <int Dim>
struct Profile;

/// Cone. Equation (1): N v_obj = (pi/3) r^3 tan(alpha).
template <>
struct Profile<3> {
  static double base_radius(double volume, double alpha) {
    return std::cbrt(3.0 * volume / (std::numbers::pi * std::tan(alpha)));
  }
  /// Volume of the frustum of height `rise` between a lower and an upper radius.
  static double slice_volume(double lower, double upper, double rise) {
    return std::numbers::pi / 3.0 * rise * (lower * lower + lower * upper + upper * upper);
  }
};

/// Wedge, equation (1)'s twin with areas: N v_obj = r^2 tan(alpha).
template <>
struct Profile<2> {
  static double base_radius(double volume, double alpha) { return std::sqrt(volume / std::tan(alpha)); }
  static double slice_volume(double lower, double upper, double rise) { return rise * (lower + upper); }
};

}  // namespace talus
