// Bodies that move further in a step than they are thick.

#include <gtest/gtest.h>

#include "tests/sim3d/heap.h"

namespace talus::fast_body_test {
namespace {

/// How many of 60 small balls, thrown at a wall 0.1 m thick from as many places within one step's way, get behind it.
template <int Dim, class MakeWorld>
int through_the_wall(double speed, MakeWorld make_world) {
  constexpr int phases = 60;
  WorldDescription<Dim> description;
  description.gravity = 0.0;
  description.ground.present = false;
  description.shapes = {make_shape<Dim>("ball", ball_pieces<Dim>(0.1), Material{})};
  Vec<Dim> wall = Vec<Dim>::Constant(400.0);
  wall[0] = 0.1;
  description.obstacles.push_back({make_shape<Dim>("wall", box_pieces<Dim>(wall), Material{}), {}});
  const auto world = make_world(description);
  for (int phase = 0; phase < phases; ++phase) {
    BodyDef<Dim> ball;
    ball.pose.position[0] = -1.0 - speed / 60.0 * phase / phases;
    ball.pose.position[Dim - 1] = phase - 30.0;  // each at a height of its own, so that they do not meet
    ball.velocity[0] = speed;
    world->add(ball);
  }
  run(*world, 30);
  int through = 0;
  for (const Pose<Dim>& pose : world->states().pose) through += pose.position[0] > 0.0 ? 1 : 0;
  return through;
}

class Speed : public testing::TestWithParam<double> {};
class SpeedInThePlane : public testing::TestWithParam<double> {};

TEST_P(Speed, TakesNoBallThroughAThinWall) { EXPECT_EQ(through_the_wall<3>(GetParam(), make_bullet_world), 0); }

TEST_P(SpeedInThePlane, TakesNoDiscThroughAThinWall) {
  EXPECT_EQ(through_the_wall<2>(GetParam(), make_bullet_planar_world), 0);
}

INSTANTIATE_TEST_SUITE_P(FastBody, Speed, testing::Values(20.0, 50.0, 100.0, 250.0, 500.0));
// In 2D the door lets in 2 m a step, all that Box2D can do.
INSTANTIATE_TEST_SUITE_P(FastBody, SpeedInThePlane, testing::Values(20.0, 50.0, 120.0));

}  // namespace
}  // namespace talus::fast_body_test
