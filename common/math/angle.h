#pragma once

#include <cmath>
#include <numbers>

#include "common/math/vector.h"

namespace talus {

constexpr double in_degrees(double radians) { return radians * 180.0 / std::numbers::pi; }
constexpr double in_radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// An angle [rad] brought into [-pi, pi]. Such an angle stays as it is, bit for bit.
inline double wrapped(double angle) {
  if (std::abs(angle) <= std::numbers::pi) return angle;
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The angle of a rotation as records and files have it [rad], in [-pi, pi]: Box2D counts whole turns and Bullet does
/// not.
inline double wrapped_angle(const Rotation<2>& rotation) { return wrapped(rotation.angle()); }

/// Rotation that turns the first axis into a direction of any length.
Rotation<2> turn_to(const Vec2& direction);
Rotation<3> turn_to(const Vec3& direction);

}  // namespace talus
