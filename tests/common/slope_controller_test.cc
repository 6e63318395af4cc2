// How bodies of a pile with slope control are damped.

#include "common/policy/adaptive/slope_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/policy/adaptive/adaptive_policy.h"
#include "tests/common/adaptive_rules.h"

namespace talus::slope_controller_test {
namespace {

/// Cubes of 1 m (D = sqrt(3) m) in a pile controlled at 45 degrees, and one more that touches the ground.
class SlopeControllerTest : public testing::Test {
 protected:
  SlopeControllerTest()
      : world_(cubes()), piles_({controlled()}, {.bounding_volume = 1.0, .extent = extent, .mass = 1.0}) {}

  static PileParams<3> controlled() {
    PileParams<3> pile;
    pile.alpha = std::numbers::pi / 4.0;
    pile.control_slope = true;
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

  RuleInput<3> in(std::int64_t step) { return input(world_, step, piles_.piles()); }

  /// The velocities after one step, with those that rules before this one gave.
  std::vector<VelocityChange<3>> damped(std::vector<VelocityChange<3>> velocities = {}) {
    SlopeController<3> controller(RuleParts{}.setup());
    RuleOutput<3> out;
    out.velocities = std::move(velocities);
    controller.update(in(0), out);
    return out.velocities;
  }

  /// Rate at which the first body in contact loses velocity in a step [1/s].
  double damping(SlopeController<3>& controller, std::int64_t step) {
    RuleOutput<3> out;
    controller.update(in(step), out);
    return -std::log(out.velocities.at(0).velocity.x() / 3.0) / cubes().dt;
  }

  /// Part of a velocity that is left after a step at the largest damping, 4 sqrt(g / D).
  static double kept() { return std::exp(-4.0 * std::sqrt(10.0 / extent) * cubes().dt); }

  static constexpr double extent = 1.7320508075688772;
  StillWorld<3> world_;
  PileSet<3> piles_;
};

TEST_F(SlopeControllerTest, ABodyOnAPileFarTooFlatIsDampedMost) {
  lay(5.0, 0.0);
  const BodyIndex body = add_moving(Vec3(1.0, 0.0, 0.5));
  const std::vector<VelocityChange<3>> velocities = damped();
  ASSERT_EQ(velocities.size(), 1U);
  EXPECT_EQ(velocities[0].body, body);
  EXPECT_NEAR((velocities[0].velocity - kept() * Vec3(3.0, 0.0, -1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((velocities[0].spin - kept() * Vec3(0.0, 2.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST_F(SlopeControllerTest, TheVelocityAfterAnImpactIsDampedInPlaceOfTheOneBefore) {
  lay(5.0, 0.0);
  const BodyIndex body = add_moving(Vec3(1.0, 0.0, 0.5));
  const std::vector<VelocityChange<3>> velocities = damped({{.body = body, .velocity = Vec3(0.0, 7.0, 0.0)}});
  ASSERT_EQ(velocities.size(), 1U);
  EXPECT_NEAR((velocities[0].velocity - kept() * Vec3(0.0, 7.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST_F(SlopeControllerTest, DampingGrowsFromUpdateToUpdateWhileSlopeIsMissing) {
  lay(5.0, 0.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  SlopeController<3> controller(RuleParts{.params = {.slope_proportional_gain = 0.0}}.setup());
  const double first = damping(controller, 0);
  EXPECT_GT(first, 0.0);
  EXPECT_NEAR(damping(controller, 1), first, 1e-9);
  EXPECT_NEAR(damping(controller, 6), 2.0 * first, 1e-9);
}

// The body falls by 0.1 m between two measurements of a pile that is steep enough.
TEST_F(SlopeControllerTest, APileThatSinksIsDampedBeforeItIsTooFlat) {
  lay(2.0, 0.1);  // 58 degrees
  const BodyIndex body = add_moving(Vec3(0.0, 0.0, 9.0));
  SlopeController<3> controller(RuleParts{}.setup());
  RuleOutput<3> before;
  controller.update(in(0), before);
  EXPECT_TRUE(before.velocities.empty());
  world_.move(body, {.position = Vec3(0.0, 0.0, 5.0)});
  EXPECT_GT(damping(controller, 6), 0.0);
}

// At rest it would be flat enough: the moving bodies at the foot are part of the pile.
TEST_F(SlopeControllerTest, BodiesInContactThatStillMoveAreMeasuredToo) {
  lay(1.0, 0.3);
  for (int i = 0; i < 60; ++i) add_moving(Vec3(6.0 + 0.01 * i, 0.0, 0.5));
  EXPECT_EQ(damped().size(), 60U);
}

TEST_F(SlopeControllerTest, TooFewBodiesLeaveTheIntegralAsItIs) {
  lay(5.0, 0.0);
  for (BodyIndex body = 5; body < 20; ++body) world_.remove(body);
  add_moving(Vec3(1.0, 0.0, 0.5));
  SlopeController<3> controller(RuleParts{}.setup());
  for (int update = 0; update < 50; ++update)
    EXPECT_NEAR(std::exp(-damping(controller, 30 * update) * cubes().dt), kept(), 1e-9);
  lay(1.0, 1.0);
  RuleOutput<3> out;
  controller.update(in(30 * 50), out);
  EXPECT_TRUE(out.velocities.empty());
}

// The other's bodies would make each pile twice as wide as it is.
TEST_F(SlopeControllerTest, ABodyBelongsToTheNearestOfTwoPilesOnly) {
  PileParams<3> beside = controlled();
  beside.at = Vec3(12.0, 0.0, 0.0);
  beside.merge_distance = 0.0;
  piles_ = PileSet<3>({controlled(), beside}, piles_.typical_body());
  lay(1.0, 1.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  for (int i = 0; i < 40; ++i)
    world_.freeze(std::vector{world_.add({.pose = {.position = Vec3(12.0 + 0.1 * i, 0.0, 0.5)}})});
  EXPECT_TRUE(damped().empty());
}

TEST_F(SlopeControllerTest, ASteepPileIsNotDamped) {
  lay(1.0, 1.0);  // twenty metres high, one wide
  add_moving(Vec3(1.0, 0.0, 0.5));
  EXPECT_TRUE(damped().empty());
}

TEST_F(SlopeControllerTest, BodiesInFlightOrFarFromThePileAreNotDamped) {
  lay(5.0, 0.0);
  world_.add({.pose = {.position = Vec3(0.0, 0.0, 6.0)}, .velocity = Vec3(0.0, 0.0, -5.0)});
  add_moving(Vec3(2.1 * piles_.piles().front().radius, 0.0, 0.5));
  EXPECT_TRUE(damped().empty());
}

TEST_F(SlopeControllerTest, APileWithoutSlopeControlIsNotDamped) {
  PileParams<3> natural = controlled();
  natural.control_slope = false;
  piles_ = PileSet<3>({natural}, piles_.typical_body());
  lay(5.0, 0.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  EXPECT_TRUE(damped().empty());
}

// In Bullet an impact may spin a body faster than set_velocity() accepts.
TEST_F(SlopeControllerTest, ABodyFasterThanTheEnginesLimitIsSlowedToIt) {
  lay(5.0, 0.0);
  add_moving(Vec3(1.0, 0.0, 0.5));
  world_.push(20, Vec3(900.0, 0.0, 0.0), Vec3(0.0, 500.0, 0.0));
  world_.record_contacts(true);
  world_.step();
  AdaptivePolicy<3> policy({}, cubes(), piles_.typical_body());
  std::vector<SleepEvent> fallen_asleep;
  for (BodyIndex body = 0; body < world_.states().size(); ++body)
    if (world_.states().asleep[body] != 0) fallen_asleep.push_back({.body = body});
  policy.note(world_, fallen_asleep);
  Decision<3> decision;
  policy.decide(frame(), decision);
  ASSERT_EQ(decision.velocities.size(), 1U);
  EXPECT_LT(decision.velocities[0].velocity.norm(), fastest_speed<3>(cubes().dt));
  EXPECT_LT(decision.velocities[0].spin.norm(), fastest_spin(cubes().dt));
}

}  // namespace
}  // namespace talus::slope_controller_test
