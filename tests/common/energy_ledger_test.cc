// The energy balance against closed forms: a body in free fall loses m g^2 dt^2 / 2 a step, as semi-implicit Euler
// does, and nothing else.

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
    const BodyIndex index = world.add(body);
    ledger.note_added(world);
    return index;
  }
  void look() {
    for (const BodyIndex body : world.awake()) ledger.note_state(world, body);
    ledger.close_step();
  }
  void set_speed(BodyIndex body, double speed) { world.set_velocity(body, {0.0, 0.0, speed}, Vec3::Zero()); }

  WorldDescription<3> description = world_of_balls();
  double mass = description.shapes[0].mass;
  FallingWorld<3> world{description};
  EnergyLedger<3> ledger{description};
};

TEST_F(Ledger, AddingBodiesIsNoRise) {
  add(50.0, -7.0);
  look();
  add(80.0, 3.0);
  look();
  EXPECT_EQ(ledger.rise(), 0.0);
}

TEST_F(Ledger, AnElasticBounceReturnsExactlyWhatTheFallTook) {
  const BodyIndex body = add(50.0, -7.0);
  look();
  set_speed(body, 7.0);
  look();
  EXPECT_EQ(ledger.rise(), 0.0);
}

TEST_F(Ledger, EnergyFromNowhereIsARiseInFull) {
  const BodyIndex body = add(50.0, -7.0);
  look();
  set_speed(body, 9.0);
  look();
  EXPECT_NEAR(ledger.rise(), 0.5 * mass * (81.0 - 49.0), 1e-6);
}

TEST_F(Ledger, AnEarlyLossDoesNotHideALateGain) {
  const BodyIndex body = add(50.0, -30.0);
  look();
  set_speed(body, 0.0);
  look();
  set_speed(body, 10.0);
  look();
  EXPECT_NEAR(ledger.rise(), 0.5 * mass * 100.0, 1e-6);
}

TEST_F(Ledger, EnergyThatThePolicyGivesIsNoRise) {
  const BodyIndex body = add(50.0);
  look();
  ledger.note_velocity(world, body, {0.0, 0.0, 12.0}, Vec3::Zero());
  set_speed(body, 12.0);
  look();
  EXPECT_NEAR(ledger.rise(), 0.0, 1e-6);
}

TEST_F(Ledger, FreezingAndThawingIsNoRise) {
  const BodyIndex body = add(50.0, 2.0);
  look();
  world.freeze(std::vector<BodyIndex>{body});
  ledger.note_state(world, body);
  ledger.close_step();
  world.thaw(std::vector<BodyIndex>{body});
  look();
  EXPECT_EQ(ledger.rise(), 0.0);
}

TEST_F(Ledger, ARemovedBodyTakesItsEnergyAway) {
  add(50.0);
  const BodyIndex high = add(5'000.0);
  look();
  world.remove(high);
  look();
  EXPECT_EQ(ledger.rise(), 0.0);
}

TEST_F(Ledger, AFallLosesWhatTheIntegratorLoses) {
  const BodyIndex body = add(1'000.0);
  for (int step = 0; step < 100; ++step) {
    world.step();
    look();
  }
  EXPECT_EQ(ledger.rise(), 0.0);
  const double lost = 100 * 0.5 * mass * gravity * gravity * dt * dt;
  const double speed = -world.states().velocity[0][2];
  set_speed(body, std::sqrt(speed * speed + 2.0 * lost / mass));  // just what it has lost, and so back at the start
  look();
  EXPECT_NEAR(ledger.rise(), lost, 1e-6 * lost);
}

TEST_F(Ledger, ToleratesATenthOfTheLargestKineticEnergy) {
  add(50.0, -20.0);
  look();
  const double extent = description.shapes[0].extent;
  const double expected = 0.1 * (0.5 * mass * 400.0 + mass * gravity * extent + 0.5 * mass * 0.25);
  EXPECT_NEAR(ledger.tolerance(), expected, 1e-9 * expected);
}

// Else a rise that was tolerated while many bodies were awake would count once they sleep.
TEST_F(Ledger, ToleratesNoLessWhenBodiesFallAsleep) {
  add(50.0);
  look();
  const double tolerance = ledger.tolerance();
  ledger.close_step();
  EXPECT_EQ(ledger.tolerance(), tolerance);
}

}  // namespace
}  // namespace talus::energy_ledger_test
