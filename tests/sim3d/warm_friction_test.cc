// The solver that remembers friction.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sim3d/heap.h"

namespace talus::warm_friction_test {
namespace {

/// How far the bodies of a heap at rest creep in 200 steps, on average [m].
double creep(unsigned seed, bool warm_friction) {
  WorldDescription<3> description = l_world<3>();
  description.solver.kind = engine_solver;
  description.solver.warm_friction = warm_friction;
  const auto world = make_bullet_world(description);
  add_stack(*world, 80, 3, seed);
  run(*world, 400);
  const std::vector<Pose<3>> before = world->states().pose;
  run(*world, 200);
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) sum += (world->states().pose[i].position - before[i].position).norm();
  return sum / static_cast<double>(before.size());
}

// Over several heaps, since in one a single body that topples late outweighs the creep of all others.
TEST(WarmFriction, HoldsHeapsThatWouldCreep) {
  std::vector<double> ratios;
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) ratios.push_back(creep(seed, true) / creep(seed, false));
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[2], 0.6);
}

/// How far a box slides down a slope in the first second [m].
double slide(double slope, bool warm_friction) {
  WorldDescription<3> description;
  description.solver.kind = engine_solver;
  description.solver.warm_friction = warm_friction;
  description.ground.present = false;
  description.shapes = {make_shape<3>("box", box_pieces<3>({1, 1, 0.5}), Material{})};
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(slope, Vec3::UnitY()));
  description.obstacles.push_back(
      {make_shape<3>("slope", box_pieces<3>({100, 10, 1}), Material{}), {Vec3::Zero(), tilt}});
  const auto world = make_bullet_world(description);
  BodyDef<3> body;
  body.pose = {tilt * Vec3(0, 0, 0.75), tilt};
  world->add(body);
  run(*world, 60);
  return (world->states().pose[0].position - body.pose.position).norm();
}

TEST(WarmFriction, ObeysCoulomb) {
  const double friction = 0.5;
  EXPECT_LT(slide(std::atan(friction) - 0.05, true), 0.01);
  const double steep = std::atan(friction) + 0.1;
  const double expected = 0.5 * 9.81 * (std::sin(steep) - friction * std::cos(steep));
  // Three parts in a hundred: half a step in sixty, and the contact that is found in the first steps.
  EXPECT_NEAR(slide(steep, true), expected, 0.03 * expected);
}

}  // namespace
}  // namespace talus::warm_friction_test
