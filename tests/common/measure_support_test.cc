#include <gtest/gtest.h>

#include <ctime>
#include <numbers>

#include "common/math/random.h"
#include "common/measure/support.h"
#include "common/shape/catalogue.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_support_test {
namespace {

WorldDescription<3> cubes_world() {
  WorldDescription<3> description;
  description.shapes = {make_shape<3>("cube", box_pieces<3>(Vec3(1, 1, 1)), Material{})};
  return description;
}

TEST(TouchingPairs, FindsTheGroundNeighboursAndObstaclesWithTheirDistances) {
  WorldDescription<3> description = cubes_world();
  description.obstacles.push_back({description.shapes[0], {Vec3(-1.03, 0, 0.5)}});
  const BodyStates<3> states = states_at<3>({{0, 0, 0.49}, {0.2, 0, 1.5}, {0, 0, 2.52}, {0, 0, 9}});
  const std::vector<Touch> touches = touching_pairs(description, states, 0.05);
  ASSERT_EQ(touches.size(), 4U);
  EXPECT_EQ(touches[0].a, 0);
  EXPECT_EQ(touches[0].b, first_obstacle);
  EXPECT_NEAR(touches[0].distance, 0.03, 1e-9);
  EXPECT_EQ(touches[1].b, ground_index);
  EXPECT_NEAR(touches[1].distance, -0.01, 1e-9);
  EXPECT_EQ(touches[2].b, 1);
  EXPECT_NEAR(touches[2].distance, 0.01, 1e-9);
  EXPECT_EQ(touches[3].a, 1);
  EXPECT_EQ(touches[3].b, 2);
  EXPECT_NEAR(touches[3].distance, 0.02, 1e-9);
}

TEST(TouchingPairs, LooksAtPiecesNotAtTheirCommonHull) {
  WorldDescription<2> description;
  description.shapes = {make_shape<2>("L", l_pieces<2>({}), Material{})};
  description.ground.present = false;
  // The centre of mass of an L of 1 x 1 x 0.4 lies 0.0125 off the inner corner. The second L is turned by 180 degrees,
  // an arm in the notch of the first, 0.64 - 0.6125 - 0.0125 from its arms: hulls overlap, bodies do not.
  BodyStates<2> states = states_at<2>({{0, 0}, {0.64, 0.3}});
  states.pose[1].rotation = Rotation<2>(std::numbers::pi);
  const std::vector<Touch> touches = touching_pairs(description, states, 0.5);
  ASSERT_EQ(touches.size(), 1U);
  EXPECT_NEAR(touches[0].distance, 0.015, 1e-9);
}

TEST(TouchingPairs, LeavesOutRemovedBodies) {
  BodyStates<3> states = states_at<3>({{0, 0, 0.5}, {0, 0, 1.5}});
  states.removed[0] = 1;
  EXPECT_TRUE(touching_pairs(cubes_world(), states, 0.05).empty());
}

TEST(TouchingPairs, OfTenThousandBodiesTakeLessThanTwoSeconds) {
  WorldDescription<3> description;
  description.shapes = {make_shape<3>("L", l_pieces<3>({}), Material{})};
  std::mt19937_64 random(1);
  BodyStates<3> states;
  std::vector<Vec3> places;
  for (int i = 0; i < 10000; ++i)  // 0.85 m apart: as dense as a heap of L shapes, 42 % solid
    places.push_back(0.85 * Vec3(i % 22, i / 22 % 22, i / 484) + uniform_within<3>(Vec3::Constant(0.1), random));
  states = states_at<3>(places);
  for (auto& pose : states.pose) pose.rotation = uniform_rotation<3>(random);
  const std::clock_t start = std::clock();  // of this process: others may be busy
  const std::vector<Touch> touches = touching_pairs(description, states, 0.05);
  const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_GT(touches.size(), 20000U);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(taken, 2.0);
#else
  EXPECT_LT(taken, 60.0);
#endif
}

TEST(FloatingSleepers, AreThoseWithNoChainToTheGround) {
  BodyStates<3> states = states_at<3>(std::vector<Vec3>(6, Vec3::Zero()));
  states.asleep = {1, 1, 1, 1, 0, 1};
  states.removed[5] = 1;
  // 0 on the ground, 1 on 0; 2 and 3 on each other only; 4 in the air but awake; 5 gone.
  const std::vector<Touch> touches = {{0, ground_index, 0.0}, {0, 1, 0.0}, {2, 3, 0.0}};
  EXPECT_EQ(floating_sleepers(states, touches), (std::vector<BodyIndex>{2, 3}));
}

TEST(FloatingSleepers, MayRestOnObstaclesAndOnAwakeBodies) {
  BodyStates<3> states = states_at<3>(std::vector<Vec3>(2, Vec3::Zero()));
  states.asleep = {0, 1};
  EXPECT_TRUE(floating_sleepers(states, std::vector<Touch>{{0, first_obstacle - 3, 0.0}, {0, 1, 0.0}}).empty());
}

TEST(Penetration, CountsGapsAsNoDepth) {
  std::vector<Touch> touches(100, Touch{0, 1, 0.02});
  touches[7].distance = -0.3;
  touches[8].distance = -0.1;
  const Penetration result = penetration(touches);
  EXPECT_EQ(result.pairs, 100);
  EXPECT_DOUBLE_EQ(result.max, 0.3);
  EXPECT_DOUBLE_EQ(result.p99, 0.1);
  EXPECT_DOUBLE_EQ(result.mean, 0.004);
  EXPECT_EQ(penetration({}).max, 0.0);
}

}  // namespace
}  // namespace talus::measure_support_test
