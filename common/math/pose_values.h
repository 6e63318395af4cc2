#pragma once
// A pose as numbers: x, z [m], angle [rad] in 2D; x, y, z [m], quaternion w, x, y, z in 3D.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/math/angle.h"
#include "common/math/vector.h"

namespace talus {

/// How many numbers a pose has.
template <int Dim>
inline constexpr std::size_t pose_values = Dim == 2 ? 3 : 7;

/// The numbers of a quaternion in the order of records and files: w, x, y, z.
inline std::array<double, 4> quaternion_values(const Rotation<3>& rotation) {
  return {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
}

template <int Dim, class Number>
void append_pose(const Pose<Dim>& pose, std::vector<Number>& values) {
  for (const double x : pose.position) values.push_back(static_cast<Number>(x));
  if constexpr (Dim == 2)
    values.push_back(static_cast<Number>(wrapped_angle(pose.rotation)));
  else
    for (const double part : quaternion_values(pose.rotation)) values.push_back(static_cast<Number>(part));
}

/// Of the first pose_values of `values`.
template <int Dim, class Number>
Pose<Dim> pose_from(std::span<const Number> values) {
  if constexpr (Dim == 2)
    return {{values[0], values[1]}, Rotation<2>(values[2])};
  else
    return {{values[0], values[1], values[2]}, Rotation<3>(values[3], values[4], values[5], values[6])};
}

}  // namespace talus
