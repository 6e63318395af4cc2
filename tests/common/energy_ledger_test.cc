// The energy balance against closed forms: a body in free fall loses m g^2 dt^2 / 2 a step, as semi-implicit Euler
// does, and nothing else. What a test does between start_step() and end_step() stands for the engine's step.

#include "common/simulation/energy_ledger.h"

#include <gtest/gtest.h>

#include "common/shape/catalogue.h"
#include "tests/common/falling_world.h"

namespace talus::energy_ledger_test {
namespace {

constexpr double gravity = 10.0;
constexpr double dt = 1.0 / 60.0;

WorldDescription<3> world_of_balls() {
  WorldDescription<3> world;
  world.gravity = gravity;
  world.dt = dt;
  world.shapes = {make_shape<3>("ball", ball_pieces<3>(0.5), {})};
  return world;
}

class Ledger : public ::testing::Test {
 protected:
  BodyIndex add(double height, double speed = 0.0) {
    BodyDef<3> body;
    body.pose.position = {0.0, 0.0, height};
    body.velocity = {0.0, 0.0, speed};
    return world.add(body);
  }
  void set_speed(BodyIndex body, double speed) { world.set_velocity(body, {0.0, 0.0, speed}, Vec3::Zero()); }
  /// A step in which the engine changes nothing but the speed of one body.
  void jump(BodyIndex body, double speed) {
    ledger.start_step(world);
    set_speed(body, speed);
    ledger.end_step(world);
  }
  void step() {
    ledger.start_step(world);
    world.step();
    ledger.end_step(world);
  }

  WorldDescription<3> description = world_of_balls();
  double mass = description.shapes[0].mass;
  FallingWorld<3> world{description};
  EnergyLedger<3> ledger{description};
};

TEST_F(Ledger, AnElasticBounceReturnsExactlyWhatTheFallTook) {
  jump(add(50.0, -7.0), 7.0);
  EXPECT_EQ(ledger.rise(), 0.0);
}

TEST_F(Ledger, EnergyFromNowhereIsARiseInFull) {
  jump(add(50.0, -7.0), 9.0);
  EXPECT_NEAR(ledger.rise(), 0.5 * mass * (81.0 - 49.0), 1e-6);
}

TEST_F(Ledger, AnEarlyLossDoesNotHideALateGain) {
  const BodyIndex body = add(50.0, -30.0);
  jump(body, 0.0);
  jump(body, 10.0);
  EXPECT_NEAR(ledger.rise(), 0.5 * mass * 100.0, 1e-6);
}

TEST_F(Ledger, WhatHappensBetweenStepsIsNoRise) {
  const BodyIndex low = add(50.0);
  step();
  const BodyIndex high = add(5'000.0, 3.0);
  step();
  set_speed(low, 12.0);
  step();
  world.freeze(std::vector<BodyIndex>{low});
  step();
  world.thaw(std::vector<BodyIndex>{low});
  step();
  world.remove(high);
  step();
  EXPECT_EQ(ledger.rise(), 0.0);
  EXPECT_NEAR(ledger.burst(), 0.0, 1e-6);
}

TEST_F(Ledger, AFallLosesWhatTheIntegratorLoses) {
  const BodyIndex body = add(1'000.0);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(ledger.rise(), 0.0);
  const double lost = 100 * 0.5 * mass * gravity * gravity * dt * dt;
  const double speed = -world.states().velocity[0][2];
  jump(body, std::sqrt(speed * speed + 2.0 * lost / mass));
  EXPECT_NEAR(ledger.rise(), lost, 1e-6 * lost) << "what the fall lost is not set against it";
}

// Kinetic energy alone is exact in a fall: the step adds what gravity does to a free body and no more.
TEST_F(Ledger, AFallIsNoBurst) {
  add(1'000.0, -3.0);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_NEAR(ledger.burst(), 0.0, 1e-9 * 0.5 * mass * 400.0);
}

TEST_F(Ledger, AnElasticBounceIsNoBurst) {
  const BodyIndex body = add(50.0, -7.0);
  ledger.start_step(world);
  set_speed(body, 7.0 + gravity * dt);  // what it had before the impact: its speed and gravity's part of the step
  ledger.end_step(world);
  EXPECT_NEAR(ledger.burst(), 0.0, 1e-6);
}

TEST_F(Ledger, SpeedFromNowhereIsABurst) {
  const BodyIndex body = add(0.5);
  step();
  EXPECT_EQ(ledger.burst(), 0.0) << "at rest on the ground";
  jump(body, 3.0);
  // The step takes gravity's part away first: the ground holds the body with the other half of the impulse.
  EXPECT_NEAR(ledger.burst(), 0.5 * mass * (9.0 - gravity * gravity * dt * dt), 1e-6);
  EXPECT_GT(ledger.created(), 0.0);
}

TEST_F(Ledger, ToleratesATenthOfTheLargestKineticEnergy) {
  const BodyIndex body = add(50.0, -20.0);
  jump(body, -20.0);
  const double extent = description.shapes[0].extent;
  const double expected = 0.1 * (0.5 * mass * 400.0 + mass * gravity * extent + 0.5 * mass * 0.25);
  EXPECT_NEAR(ledger.tolerance(), expected, 1e-9 * expected);
}

// Else a rise that was tolerated while many bodies were awake would count once they sleep.
TEST_F(Ledger, ToleratesNoLessWhenBodiesFallAsleep) {
  const BodyIndex body = add(50.0);
  jump(body, 0.0);
  const double tolerance = ledger.tolerance();
  world.freeze(std::vector<BodyIndex>{body});
  step();
  EXPECT_EQ(ledger.tolerance(), tolerance);
}

}  // namespace
}  // namespace talus::energy_ledger_test
