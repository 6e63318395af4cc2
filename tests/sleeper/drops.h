#pragma once
// The same rain of boxes for every world of these tests.

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "common/math/vector.h"

namespace talus::test {

inline constexpr int steps_between_drops = 12;  // 5 boxes a second at 60 steps a second
inline constexpr double drop_dt = 1.0 / 60.0;   // [s]

template <int Dim>
Vec<Dim> box_size() {
  if constexpr (Dim == 2)
    return {1.0, 0.6};
  else
    return {1.0, 0.7, 0.5};
}

inline double fraction(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

inline Rotation<2> random_rotation(std::mt19937& random, std::integral_constant<int, 2>) {
  return Rotation<2>(2.0 * std::numbers::pi * fraction(random));
}
inline Rotation<3> random_rotation(std::mt19937& random, std::integral_constant<int, 3>) {
  Eigen::Vector4d q;
  do
    for (int i = 0; i < 4; ++i) q[i] = 2.0 * fraction(random) - 1.0;
  while (q.squaredNorm() > 1.0 || q.squaredNorm() < 0.01);
  return Rotation<3>(q.normalized());
}

/// Of a heap of so many boxes on level ground, with slopes of 30 degrees and a fifth of it empty [m].
template <int Dim>
double heap_height(int boxes) {
  const double volume = boxes * box_size<Dim>().prod() / 0.8;
  const double slope = 1.0 / std::numbers::sqrt3;
  return Dim == 2 ? std::sqrt(slope * volume) : std::cbrt(3.0 / std::numbers::pi * slope * slope * volume);
}

/// Where and how `count` boxes start, one after the other, above the heap of those before; up is the last axis.
template <int Dim>
std::vector<Pose<Dim>> drops(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Pose<Dim>> poses(count);
  for (int i = 0; i < count; ++i) {
    Pose<Dim>& pose = poses[i];
    pose.rotation = random_rotation(random, std::integral_constant<int, Dim>{});
    for (int axis = 0; axis + 1 < Dim; ++axis) pose.position[axis] = 0.6 * fraction(random) - 0.3;
    pose.position[Dim - 1] = (Dim == 2 ? 14.0 : 8.0) + heap_height<Dim>(i);
  }
  return poses;
}

}  // namespace talus::test
