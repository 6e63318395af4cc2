#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/spout_rate.h"
#include "common/shape/catalogue.h"
#include "common/shape/shape.h"

namespace talus::scene_spout_test {
namespace {

constexpr double g = 9.81;
constexpr double radius = 0.5;

// A world of balls with a step so short that whole steps hardly show: 0.1 ms.
template <int Dim>
WorldDescription<Dim> fine_world() {
  WorldDescription<Dim> world;
  world.gravity = g;
  world.dt = 1e-4;
  world.shapes = {make_shape<Dim>("ball", ball_pieces<Dim>(radius), {})};
  return world;
}

// A whole step too many, and semi-implicit Euler's lead of half a step over the closed form.
constexpr double two_steps = 2e-4;

TEST(Spout, IsClearWhenABodyHasFallenByItsDiameterFromRest) {
  EXPECT_NEAR(clearing_time<3>({}, fine_world<3>()), std::sqrt(2.0 * 2.0 * radius / g), two_steps);
}

TEST(Spout, IsClearSoonerWhenBodiesAreThrownDown) {
  const Source<3> source{.velocity = Vec3(0.0, 0.0, -10.0)};
  const double time = (-10.0 + std::sqrt(100.0 + 2.0 * g * 2.0 * radius)) / g;
  EXPECT_NEAR(clearing_time(source, fine_world<3>()), time, two_steps);
}

TEST(Spout, IsClearWhenWhatWasThrownUpHasComeBackAndLeft) {
  const Source<2> source{.velocity = Vec2(0.0, 5.0)};
  const double time = (5.0 + std::sqrt(25.0 + 2.0 * g * 2.0 * radius)) / g;
  EXPECT_NEAR(clearing_time(source, fine_world<2>()), time, two_steps);
}

TEST(Spout, CountsTheSlowestAndTheNearestOfASpread) {
  const Source<2> source{.spread = Vec2(0.0, 0.3), .velocity = Vec2(0.0, -4.0), .velocity_spread = Vec2(0.0, 1.0)};
  const double time = (-3.0 + std::sqrt(9.0 + 2.0 * g * (2.0 * radius + 0.6))) / g;
  EXPECT_NEAR(clearing_time(source, fine_world<2>()), time, two_steps);
}

TEST(Spout, IsClearedSidewaysWhereThatIsFaster) {
  const Source<3> source{.velocity = Vec3(0.0, -20.0, 0.0), .velocity_spread = Vec3(0.0, 4.0, 0.0)};
  EXPECT_NEAR(clearing_time(source, fine_world<3>()), 2.0 * radius / 16.0, two_steps);
}

TEST(Spout, ThatSweepsAfterItsBodyIsClearedLater) {
  // To and fro over 8 m in 2 s: 4 m/s after a body of 10 m/s.
  const Source<2> source{.velocity = Vec2(10.0, 0.0), .sweep = Vec2(2.0, 0.0), .sweep_period = 2.0};
  EXPECT_NEAR(clearing_time(source, fine_world<2>()), 2.0 * radius / 6.0, two_steps);
}

TEST(Spout, IsNeverClearedWithoutGravityAndSpeed) {
  WorldDescription<3> world = fine_world<3>();
  world.gravity = 0.0;
  EXPECT_TRUE(std::isinf(clearing_time<3>({}, world)));
  EXPECT_EQ(reachable_rate<3>({}, world), 0.0);
}

TEST(Spout, MakesRoomForTheLargestOfItsShapes) {
  WorldDescription<3> world = fine_world<3>();
  world.shapes.push_back(make_shape<3>("large", ball_pieces<3>(2.0 * radius), {}));
  EXPECT_NEAR(clearing_time<3>({.shapes = {0, 1}}, world), std::sqrt(2.0 * 4.0 * radius / g), two_steps);
}

TEST(ReachableRate, IsWhatIsAskedForIfTheSpoutKeepsUp) {
  EXPECT_EQ(reachable_rate<3>({.rate = 1.0}, fine_world<3>()), 1.0);
}

TEST(ReachableRate, IsOneBodyPerWholeStepsOfTheWorld) {
  WorldDescription<3> world = fine_world<3>();
  world.dt = 1.0 / 60.0;
  // Falling 1 m takes 27 steps: 27 * 28 / 2 * g / 3600 = 1.03 m, 26 steps only 0.96 m.
  EXPECT_NEAR(reachable_rate<3>({.rate = 1000.0}, world), 60.0 / 27.0, 1e-12);
}

TEST(BoundingRadius, IsThatOfTheFarthestPointOfAnyPiece) {
  EXPECT_NEAR(bounding_radius(make_shape<3>("box", box_pieces<3>({2.0, 4.0, 4.0}), {})), 3.0, 1e-12);
  EXPECT_NEAR(bounding_radius(make_shape<2>("capsule", capsule_pieces<2>(3.0, 0.5), {})), 1.5, 1e-12);
  const std::vector<Vec2> triangle = {{0.0, 0.0}, {3.0, 0.0}, {0.0, 3.0}};  // centre of mass (1, 1)
  EXPECT_NEAR(bounding_radius(make_shape<2>("hull", hull_pieces<2>(triangle), {})), std::sqrt(5.0), 1e-12);
  const Shape<2> l = make_shape<2>("L", l_pieces<2>({}), {});
  EXPECT_NEAR(bounding_radius(l), (Vec2(1.0, 0.0) + l.reference).norm(), 1e-12);
}

}  // namespace
}  // namespace talus::scene_spout_test
