#pragma once
// A plane scene in space: it lies in y = 0.

#include "common/math/vector.h"

namespace talus {

inline Vec3 in_space(const Vec3& vector) { return vector; }
inline Vec3 in_space(const Vec2& vector) { return {vector.x(), 0.0, vector.y()}; }
inline Pose<3> in_space(const Pose<3>& pose) { return pose; }
inline Pose<3> in_space(const Pose<2>& pose) {
  // Counter-clockwise with x to the right and z up is about -y.
  return {in_space(pose.position), Rotation<3>(Eigen::AngleAxisd(pose.rotation.angle(), -Vec3::UnitY()))};
}

}  // namespace talus
