// Which grip bodies of a pile with slope control get.

#include "common/simulation/slope_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/common/cubes.h"

namespace talus::slope_control_test {
namespace {

constexpr float most = 3.0F;

/// Cubes of 1 m (D = sqrt(3) m) in a pile controlled at 45 degrees.
class SlopeControlTest : public testing::Test {
 protected:
  static constexpr double extent = 1.7320508075688772;

  SlopeControlTest()
      : world_(cubes()), piles_({controlled()}, {.bounding_volume = 1.0, .extent = extent, .mass = 1.0}) {}

  static PileParams<3> controlled() {
    PileParams<3> pile;
    pile.alpha = std::numbers::pi / 4.0;
    pile.control_slope = true;
    pile.at = Vec3::Zero();
    pile.initial_size = 1000.0;
    return pile;
  }

  static Scene<3> scene() {
    Scene<3> scene;
    scene.world = cubes();
    scene.piles = {controlled()};
    return scene;
  }

  BodyIndex add(const Vec3& place, bool touches = true) {
    const BodyIndex body = world_.add({.pose = {.position = place}});
    if (touches) piles_.note_touch(world_.states(), body);
    return body;
  }

  /// Twenty bodies on a ring, each so much higher than the last.
  std::vector<BodyIndex> lay(double from_axis, double rise) {
    std::vector<BodyIndex> bodies;
    for (int i = 0; i < 20; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / 20;
      bodies.push_back(add(Vec3(from_axis * std::cos(turn), from_axis * std::sin(turn), 0.5 + rise * i)));
    }
    return bodies;
  }

  /// The next measurement. Returns the bodies to wake.
  std::vector<BodyIndex> measure() {
    const std::span<const BodyIndex> held = control_.update(world_, piles_, step_);
    step_ += steps_between;
    return {held.begin(), held.end()};
  }
  float grip(BodyIndex body) const { return grip_between(world_.states(), body, ground_index); }

  // 0.12 sqrt(D / g), in steps of 1/60 s.
  static inline const auto steps_between = std::llround(0.12 * std::sqrt(extent / 10.0) * 60.0);

  StillWorld<3> world_;
  PileSet<3> piles_;
  SlopeControl<3> control_{scene()};
  std::int64_t step_ = 0;
};

TEST_F(SlopeControlTest, BodiesOfAPileFarTooFlatGetTheLargestGrip) {
  lay(5.0, 0.0);
  EXPECT_TRUE(measure().empty());
  for (const BodyIndex body : world_.awake()) EXPECT_EQ(grip(body), most);
}

TEST_F(SlopeControlTest, BodiesOfASteepPileGetNone) {
  lay(1.0, 1.0);  // twenty metres high, one wide
  measure();
  for (const BodyIndex body : world_.awake()) EXPECT_EQ(grip(body), 0.0F);
}

// A cone of the median radius 2 m is 4 m wide, one with its centre of mass at 0.995 m is 3.98 m high: 44.86 degrees.
// At 100 a radian the missing 0.0025 radians give a quarter.
TEST_F(SlopeControlTest, GripFollowsTheMissingSlope) {
  for (const BodyIndex body : lay(2.0, 0.0))
    world_.move(body, {.position = world_.states().pose[body].position + Vec3(0, 0, 0.495)});
  measure();
  EXPECT_NEAR(grip(0), 100.0 * (std::numbers::pi / 4.0 - std::atan(3.98 / 4.0)), 1e-3);
}

// The bodies sink by 1 mm between two measurements of a pile that is steeper than 45 degrees by 0.0025 radians.
TEST_F(SlopeControlTest, APileThatSinksGetsGripBeforeItIsTooFlat) {
  const std::vector<BodyIndex> bodies = lay(2.0, 0.0);
  const auto lift = [&](double by) {
    for (const BodyIndex body : bodies)
      world_.move(body, {.position = world_.states().pose[body].position + Vec3(0, 0, by)});
  };
  lift(0.506);
  measure();
  EXPECT_EQ(grip(0), 0.0F);
  lift(-0.001);
  measure();
  const double sunk = std::atan(4.024 / 4.0) - std::atan(4.02 / 4.0);
  const double interval = static_cast<double>(steps_between) / 60.0 / std::sqrt(extent / 10.0);
  EXPECT_NEAR(grip(0), 100.0 * (std::numbers::pi / 4.0 - std::atan(4.02 / 4.0) + 2.0 * sunk / interval), 1e-3);
}

TEST_F(SlopeControlTest, TooFewBodiesForASlopeGetTheLargestGrip) {
  for (int i = 0; i < 15; ++i) add(Vec3(0.0, 0.0, 0.5 + i));
  measure();
  EXPECT_EQ(grip(0), most);
}

// Without them the pile would be steep.
TEST_F(SlopeControlTest, BodiesThatMoveAreMeasuredAndThoseInFlightAreNot) {
  lay(1.0, 1.0);
  std::vector<BodyIndex> flying;
  for (int i = 0; i < 60; ++i) flying.push_back(add(Vec3(6.0 + 0.01 * i, 0.0, 0.5), false));
  measure();
  EXPECT_EQ(grip(0), 0.0F);
  for (const BodyIndex body : flying) piles_.note_touch(world_.states(), body);
  measure();
  EXPECT_EQ(grip(0), most);
}

TEST_F(SlopeControlTest, ABodyThatLeavesThePileLosesItsGrip) {
  const std::vector<BodyIndex> bodies = lay(5.0, 0.0);
  measure();
  world_.move(bodies[0], {.position = Vec3(2.1 * piles_.piles().front().radius, 0.0, 0.5)});
  world_.move(bodies[1], {.position = Vec3(0.0, 0.0, -0.5)});
  world_.move(bodies[2], {.position = Vec3(0.0, 0.0, 2.1 * piles_.piles().front().height)});
  measure();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(grip(bodies[i]), i < 3 ? 0.0F : most) << i;
}

// The other's bodies would make each pile twice as wide as it is.
TEST_F(SlopeControlTest, ABodyBelongsToTheNearestOfTwoPilesOnly) {
  PileParams<3> beside = controlled();
  beside.at = Vec3(12.0, 0.0, 0.0);
  beside.merge_distance = 0.0;
  piles_ = PileSet<3>({controlled(), beside}, piles_.typical_body());
  lay(1.0, 1.0);
  const BodyIndex flat = add(Vec3(12.0, 0.0, 0.5));
  for (int i = 1; i < 40; ++i) add(Vec3(12.0 + 0.1 * i, 0.0, 0.5));
  measure();
  EXPECT_EQ(grip(0), 0.0F);
  EXPECT_EQ(grip(flat), most);
}

TEST_F(SlopeControlTest, APileWithoutSlopeControlGetsNoGrip) {
  PileParams<3> natural = controlled();
  natural.control_slope = false;
  piles_ = PileSet<3>({natural}, piles_.typical_body());
  lay(5.0, 0.0);
  measure();
  EXPECT_EQ(grip(0), 0.0F);
}

TEST_F(SlopeControlTest, DoesNothingWithTheEnginesOwnSolvers) {
  Scene<3> own = scene();
  own.world.solver.kind = engine_solver;
  EXPECT_FALSE(SlopeControl<3>(own).active());
  own.piles.clear();
  own.world.solver.kind = small_steps_solver;
  EXPECT_FALSE(SlopeControl<3>(own).active());
}

TEST_F(SlopeControlTest, ASleepingBodyKeepsItsGripUnlessItsPileIsTooSteep) {
  const std::vector<BodyIndex> bodies = lay(2.0, 0.0);
  measure();
  world_.freeze(std::vector{bodies[3], bodies[7]});
  const auto raise_to = [&](double height) {
    for (const BodyIndex body : bodies) {
      Vec3 place = world_.states().pose[body].position;
      place.z() = height;
      world_.move(body, {.position = place});
    }
  };
  raise_to(1.01);  // 45.3 degrees
  EXPECT_TRUE(measure().empty());
  EXPECT_EQ(grip(bodies[0]), 0.0F);
  EXPECT_EQ(grip(bodies[3]), most);
  raise_to(1.05);  // 46.4 degrees
  EXPECT_EQ(measure(), (std::vector{bodies[3], bodies[7]}));
}

}  // namespace
}  // namespace talus::slope_control_test
