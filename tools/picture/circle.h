#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Points around a level circle in order, in 2D the two ends of its diameter.
template <int Dim>
std::vector<Vec<Dim>> circle(const Vec<Dim>& centre, double radius, int points) {
  if constexpr (Dim == 2) {
    return {centre - Vec2(radius, 0.0), centre + Vec2(radius, 0.0)};
  } else {
    std::vector<Vec3> rim;
    for (int i = 0; i < points; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / points;
      rim.push_back(centre + radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    return rim;
  }
}

}  // namespace talus
