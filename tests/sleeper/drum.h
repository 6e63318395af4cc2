#pragma once
// Drums that turn, in which all boxes move: what a sleeper adds to a step of its engine.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include "common/math/vector.h"
#include "common/measure/ensemble.h"

namespace talus::test {

inline constexpr double wall = 1.0;       // [m]
inline constexpr float drum_spin = 0.7F;  // [rad/s]
inline constexpr int drum_sides = 8;

/// Boxes fill a third of the drum.
inline double drum_radius(int boxes) { return 9.0 * std::sqrt(boxes / 300.0); }

/// Where box number `i` starts in the drum, in rows `per_row` wide.
inline Vec2 start(int i, int per_row, double radius) {
  return {1.2 * (i % per_row - 0.5 * (per_row - 1)), 1.0 * (i / per_row) - 0.5 * radius};
}

/// The middle of a side of the drum and its angle.
inline Pose<2> side(int number, double radius) {
  const double angle = 2.0 * std::numbers::pi * number / drum_sides;
  return {radius * Vec2(std::cos(angle), std::sin(angle)), Rotation<2>(angle)};
}
inline double side_length(double radius) { return 2.0 * (radius + wall) * std::tan(std::numbers::pi / drum_sides); }

/// Processor time of some steps [s].
template <typename Drum>
double time_of_steps(Drum& drum, int steps) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < steps; ++i) drum.step();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Two drums of the same bits take turns. `most`: of a step of the engine.
template <typename Drum>
void expect_small_cost(int boxes, double most = 0.1) {
  constexpr int rounds = 10;
  Drum plain(boxes, false);
  Drum attached(boxes, true);
  std::vector<double> shares;
  double total = 0.0;
  for (int round = -1; round < rounds; ++round) {  // the first one warms up
    const double engine = time_of_steps(plain, 60);
    const double share = time_of_steps(attached, 60) / engine - 1.0;
    if (round < 0) continue;
    shares.push_back(share);
    total += engine;
  }
  const MeanWithError share = mean_with_error(shares);
  fmt::print("{}, {} boxes that all move: a sleeper adds {:.3f} +- {:.3f} to {:.3f} ms a step\n", Drum::name(), boxes,
             share.mean, share.error, 1e3 * total / (60 * rounds));
  EXPECT_EQ(attached.asleep(), 0);
  EXPECT_EQ(plain.state(), attached.state());
  EXPECT_LT(share.mean - 3.0 * share.error, most);
}

}  // namespace talus::test
