// How bodies of a pile that is held to a slope are slowed.

#include "common/policy/steering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/policy/adaptive_policy.h"
#include "tests/common/cubes.h"

namespace talus::steering_test {
namespace {

/// Cubes of 1 m (D = sqrt(3) m) in a pile held to 45 degrees, and one more that touches the ground.
class SteeringTest : public testing::Test {
 protected:
  SteeringTest() : world_(cubes()), piles_({held()}, {.bounding_volume = 1.0, .extent = extent, .mass = 1.0}) {}

  static PileParams<3> held() {
    PileParams<3> pile;
    pile.alpha = std::numbers::pi / 4.0;
    pile.hold_slope = true;
    pile.at = Vec3::Zero();
    pile.initial_size = 1000.0;
    return pile;
  }

  /// Twenty sleepers, each so far from the axis and from the last one's height.
  void lay(double from_axis, double rise) {
    std::vector<BodyIndex> bodies;
    for (int i = 0; i < 20; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / 20;
      const Vec3 place(from_axis * std::cos(turn), from_axis * std::sin(turn), 0.5 + rise * i);
      bodies.push_back(world_.add({.pose = {.position = place}}));
    }
    world_.freeze(bodies);
  }

  BodyIndex add_moving(const Vec3& place) {
    const BodyIndex body =
        world_.add({.pose = {.position = place}, .velocity = Vec3(3.0, 0.0, -1.0), .spin = Vec3(0.0, 2.0, 0.0)});
    world_.touching.push_back({.a = body});
    return body;
  }

  Frame<3> frame() { return {.step = 0, .world = world_, .piles = piles_, .events = {}, .phases = {}}; }

  std::vector<Kick<3>> steered(std::vector<Kick<3>> kicks = {}) {
    Steering<3> steering({}, extent, cubes());
    steering.update(frame(), world_.contacts(), kicks);
    return kicks;
  }

  /// Rate at which the first body that touches something loses motion after so many steps [1/s].
  double drag(Steering<3>& steering, std::int64_t step) {
    std::vector<Kick<3>> kicks;
    const Frame<3> at{.step = step, .world = world_, .piles = piles_, .events = {}, .phases = {}};
    steering.update(at, world_.contacts(), kicks);
    return -std::log(kicks.at(0).velocity.x() / 3.0) / cubes().dt;
  }

  /// Of a body's motion that is left after a step at the largest drag, 4 sqrt(g / D).
  static double kept() { return std::exp(-4.0 * std::sqrt(10.0 / extent) * cubes().dt); }

  static constexpr double extent = 1.7320508075688772;
  StillWorld<3> world_;
  PileSet<3> piles_;
};

TEST_F(SteeringTest, ABodyThatTouchesAPileFarTooFlatLosesAsMuchAsTheLargestDragTakes) {
  lay(5.0, 0.0);
  const BodyIndex body = add_moving(Vec3(1.0, 0.0, 0.5));
  const std::vector<Kick<3>> kicks = steered();
  ASSERT_EQ(kicks.size(), 1U);
  EXPECT_EQ(kicks[0].body, body);
  EXPECT_NEAR((kicks[0].velocity - kept() * Vec3(3.0, 0.0, -1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((kicks[0].spin - kept() * Vec3(0.0, 2.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST_F(SteeringTest, WhatABlowGaveABodyIsSlowedAndNoSecondKickGiven) {
  lay(5.0, 0.0);
  const BodyIndex body = add_moving(Vec3(1.0, 0.0, 0.5));
  const std::vector<Kick<3>> kicks = steered({{.body = body, .velocity = Vec3(0.0, 7.0, 0.0)}});
  ASSERT_EQ(kicks.size(), 1U);
  EXPECT_NEAR((kicks[0].velocity - kept() * Vec3(0.0, 7.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST_F(SteeringTest, DragGrowsFromLookToLookWhileSlopeIsMissing) {
  lay(5.0, 0.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  Steering<3> steering({.steering_gain = 0.0}, extent, cubes());
  const double first = drag(steering, 0);
  EXPECT_GT(first, 0.0);
  EXPECT_NEAR(drag(steering, 1), first, 1e-9);
  EXPECT_NEAR(drag(steering, 30), 2.0 * first, 1e-9);
}

TEST_F(SteeringTest, OfFewBodiesNothingIsLearnt) {
  lay(5.0, 0.0);
  for (BodyIndex body = 5; body < 20; ++body) world_.remove(body);
  add_moving(Vec3(1.0, 0.0, 0.5));
  Steering<3> steering({}, extent, cubes());
  for (int look = 0; look < 50; ++look) EXPECT_NEAR(std::exp(-drag(steering, 30 * look) * cubes().dt), kept(), 1e-9);
  lay(1.0, 1.0);
  std::vector<Kick<3>> kicks;
  const Frame<3> at{.step = 30 * 50, .world = world_, .piles = piles_, .events = {}, .phases = {}};
  steering.update(at, world_.contacts(), kicks);
  EXPECT_TRUE(kicks.empty());
}

// The other's bodies would make each pile twice as wide as it is.
TEST_F(SteeringTest, ABodyBelongsToTheNearestOfTwoPilesAlone) {
  PileParams<3> beside = held();
  beside.at = Vec3(12.0, 0.0, 0.0);
  beside.merge_distance = 0.0;
  piles_ = PileSet<3>({held(), beside}, piles_.typical_body());
  lay(1.0, 1.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  for (int i = 0; i < 40; ++i) {
    world_.freeze(std::vector{world_.add({.pose = {.position = Vec3(12.0 + 0.1 * i, 0.0, 0.5)}})});
  }
  EXPECT_TRUE(steered().empty());
}

TEST_F(SteeringTest, ASteepPileMovesFreely) {
  lay(1.0, 1.0);  // twenty metres high, one wide
  add_moving(Vec3(1.0, 0.0, 0.5));
  EXPECT_TRUE(steered().empty());
}

TEST_F(SteeringTest, WhatFliesOrLiesFarFromThePileMovesFreely) {
  lay(5.0, 0.0);
  world_.add({.pose = {.position = Vec3(0.0, 0.0, 6.0)}, .velocity = Vec3(0.0, 0.0, -5.0)});
  add_moving(Vec3(2.1 * piles_.piles().front().radius, 0.0, 0.5));
  EXPECT_TRUE(steered().empty());
}

TEST_F(SteeringTest, APileThatNobodyHoldsMovesFreely) {
  PileParams<3> natural = held();
  natural.hold_slope = false;
  piles_ = PileSet<3>({natural}, piles_.typical_body());
  lay(5.0, 0.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  EXPECT_TRUE(steered().empty());
}

// Bullet lets a blow spin a body faster than it will ever turn it, and a world refuses to be given that.
TEST_F(SteeringTest, ABodyFasterThanEnginesMoveItIsGivenWhatTheyTake) {
  lay(5.0, 0.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  world_.set_velocity(20, Vec3(900.0, 0.0, 0.0), Vec3(0.0, 500.0, 0.0));
  AdaptivePolicy<3> policy({}, cubes(), piles_.typical_body());
  Decision<3> decision;
  policy.decide(frame(), decision);
  ASSERT_EQ(decision.kicks.size(), 1U);
  EXPECT_LT(decision.kicks[0].velocity.norm(), fastest_speed<3>(cubes().dt));
  EXPECT_LT(decision.kicks[0].spin.norm(), fastest_spin(cubes().dt));
}

}  // namespace
}  // namespace talus::steering_test
