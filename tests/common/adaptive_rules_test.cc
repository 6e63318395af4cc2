// Rules of the policy `adaptive`, each with contacts made for the test.

#include "tests/common/adaptive_rules.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "common/policy/adaptive/adaptive_policy.h"
#include "common/policy/adaptive/support_criterion.h"
#include "common/policy/wake_rules/impacts.h"
#include "common/policy/wake_rules/impacts_ahead.h"
#include "common/policy/wake_rules/support_loss.h"
#include "common/shape/rigid_impulse.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"

namespace talus::adaptive_rules_test {
namespace {

TEST(RuleOutput, HasOneVelocityForEachBodyWhichBeginsWithItsOwn) {
  StillWorld<3> world = cubes_at({Vec3::Zero(), Vec3::UnitX()});
  world.set_velocity(0, Vec3::UnitZ(), Vec3::UnitY());
  RuleOutput<3> out;
  out.velocity_of(1, world.states()).velocity = Vec3::UnitX();
  EXPECT_EQ(out.velocity_of(0, world.states()).velocity, Vec3::UnitZ());
  EXPECT_EQ(out.velocity_of(1, world.states()).velocity, Vec3::UnitX());
  ASSERT_EQ(out.velocities.size(), 2U);
  EXPECT_EQ(out.velocities[0].body, 0);
  EXPECT_EQ(out.velocities[0].spin, Vec3::UnitY());
}

TEST(RigidImpulse, AtTheCentreChangesVelocityByTheMassAlone) {
  const Shape<3> cube = cubes().shapes.front();
  EXPECT_DOUBLE_EQ(inverse_effective_mass<3>(cube, {}, Vec3::Zero(), Vec3::UnitX()), 1.0);
}

TEST(RigidImpulse, OffTheCentreAlsoTurnsTheBody) {
  const Shape<3> cube = cubes().shapes.front();
  const Pose<3> pose{.position = Vec3(1.0, 2.0, 3.0)};
  const Vec3 point = pose.position + Vec3(0.0, 0.0, 0.5);
  // 1/m + l^2/I = 1 + 0.25 * 6
  EXPECT_NEAR(inverse_effective_mass<3>(cube, pose, point, Vec3::UnitX()), 2.5, 1e-12);
  Vec3 velocity = Vec3::Zero();
  Spin<3> spin = Spin<3>::Zero();
  apply_impulse<3>(cube, pose, point, 2.0 * Vec3::UnitX(), velocity, spin);
  EXPECT_NEAR((velocity - Vec3(2.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((spin - Vec3(0.0, 6.0, 0.0)).norm(), 0.0, 1e-12);  // l J / I about y
}

/// Cube 1 on cube 0 on the ground, each weighing 1 N s a step.
std::vector<Contact<3>> stack_of_two() {
  return {contact(0, ground_index, Vec3::Zero(), Vec3::UnitZ(), 2.0),
          contact(0, 1, Vec3(0.0, 0.0, 1.0), -Vec3::UnitZ(), 1.0)};
}

/// Those of `candidates` that are supported. The weight of a cube is 1 N s a step.
std::vector<BodyIndex> supported(StillWorld<3> world, std::vector<Contact<3>> contacts,
                                 std::vector<BodyIndex> candidates) {
  world.set_gravity(Vec3(0.0, 0.0, -60.0));
  world.touching = std::move(contacts);
  SupportCriterion<3>(RuleParts{}.setup()).keep_supported(input(world), candidates);
  return candidates;
}

TEST(SupportCriterion, KeepsAStackThatRestsAsAWhole) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  EXPECT_EQ(supported(world, stack_of_two(), {0, 1}), (std::vector<BodyIndex>{0, 1}));
}

TEST(SupportCriterion, RemovesABodyOnOneThatStaysAwake) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  EXPECT_TRUE(supported(world, stack_of_two(), {1}).empty());
}

TEST(SupportCriterion, RemovesAWholeTowerWithItsLowestBody) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5), Vec3(0.0, 0.0, 2.5)});
  // Nothing supports the lowest: it falls, and the others with it.
  const std::vector<Contact<3>> contacts = {contact(0, 1, Vec3(0.0, 0.0, 1.0), -Vec3::UnitZ(), 1.0),
                                            contact(1, 2, Vec3(0.0, 0.0, 2.0), -Vec3::UnitZ(), 1.0)};
  EXPECT_TRUE(supported(world, contacts, {0, 1, 2}).empty());
}

TEST(SupportCriterion, AsksForTheWeightInTheGravityOfTheStep) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5)});
  std::vector<BodyIndex> candidates = {0};
  world.touching = {contact(0, ground_index, Vec3::Zero(), Vec3::UnitZ(), 1.6 / 60.0)};
  const SupportCriterion<3> support(RuleParts{}.setup());
  world.set_gravity(Vec3(0.0, 0.0, -1.6));
  support.keep_supported(input(world), candidates);
  EXPECT_EQ(candidates.size(), 1U) << "on the Moon";
  world.set_gravity(Vec3(0.0, 0.0, -10.0));
  support.keep_supported(input(world), candidates);
  EXPECT_TRUE(candidates.empty());
}

TEST(SupportCriterion, CountsWhatCarriesAgainstGravityThatPullsToTheSide) {
  StillWorld<3> world = cubes_at({Vec3(0.5, 0.0, 5.0)});
  std::vector<BodyIndex> candidates = {0};
  world.set_gravity(Vec3(-10.0, 0.0, 0.0));
  world.touching = {contact(0, first_obstacle, Vec3(0.0, 0.0, 5.0), Vec3::UnitX(), 10.0 / 60.0)};
  SupportCriterion<3>(RuleParts{}.setup()).keep_supported(input(world), candidates);
  EXPECT_EQ(candidates.size(), 1U) << "a wall carries it";
}

TEST(SupportCriterion, RemovesABodyInFlight) {
  EXPECT_TRUE(supported(cubes_at({Vec3(0.0, 0.0, 5.0)}), {}, {0}).empty());
}

/// Whether the policy freezes a cube that rests on the ground with its centre at this height.
bool sleeps_at(double height) {
  Scene<3> scene;
  scene.world = cubes();
  auto world = std::make_unique<StillWorld<3>>(scene.world);
  const double weight = scene.world.shapes[0].mass * scene.world.gravity * scene.world.dt;
  world->touching = {contact(0, ground_index, Vec3::Zero(), Vec3::UnitZ(), weight)};
  Simulation<3> simulation(scene, std::move(world), make_policy(scene));
  simulation.add({.pose = {.position = Vec3(0.0, 0.0, height)}});
  for (int step = 0; step < 60; ++step) simulation.step();
  return simulation.world().awake().empty();
}

TEST(AdaptivePolicy, LetsABodySleepOnTheGroundAndNotBelowIt) {
  EXPECT_TRUE(sleeps_at(0.1));
  EXPECT_FALSE(sleeps_at(-0.1));
}

/// How often the policy takes contacts out of a world in which a cube that rests or falls is simulated so long.
int gathers_of(int steps, const Vec3& velocity, int rings) {
  const RuleParts parts;
  AdaptivePolicy<3> policy({.rings = rings}, cubes(), parts.typical);
  const PileSet<3> piles({}, parts.typical);
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5)});
  world.record_contacts(true);
  for (int step = 1; step <= steps; ++step) {
    world.step();
    world.move(0, {.position = world.states().pose[0].position + world.dt() * velocity});
    Decision<3> decision;
    policy.decide({.step = step, .world = world, .piles = piles, .events = {}, .phases = {}}, decision);
  }
  return world.gathers;
}

TEST(AdaptivePolicy, ReadsContactsWithARingOnlyWhereABodyHasRestedLongEnough) {
  EXPECT_EQ(gathers_of(60, Vec3::UnitZ(), 2), 0);
  EXPECT_EQ(gathers_of(60, Vec3::UnitZ(), 0), 60) << "the rules read them in each step";
  EXPECT_GT(gathers_of(60, Vec3::Zero(), 2), 0);
}

TEST(World, KeepsTheContactsOfAStepHoweverLateTheyAreRead) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5)});
  world.touching = {contact(0, ground_index, Vec3::Zero(), Vec3::UnitZ(), 1.0)};
  world.record_contacts(true);
  world.step();
  EXPECT_EQ(world.gathers, 0) << "nothing has read them";
  world.freeze(std::vector<BodyIndex>{0});
  world.touching.clear();
  EXPECT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.gathers, 1);
}

/// The rule with a slack of 0.01 m, and the bodies that it wakes in each step.
struct SupportLossRule {
  SupportLoss<3> rule{RuleParts{.params = {.support_slack = 0.01}, .extent = 1.0}.setup()};

  std::vector<BodyIndex> woken(StillWorld<3>& world, std::vector<Contact<3>> contacts) {
    world.touching = std::move(contacts);
    RuleOutput<3> out;
    rule.update(input(world), out);
    return bodies_in(out.wakes);
  }
};

TEST(SupportLoss, WakesABodyWhoseSupportMovedAway) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  world.freeze(std::vector<BodyIndex>{1});
  SupportLossRule loss;
  EXPECT_TRUE(loss.woken(world, stack_of_two()).empty());
  world.move(0, {.position = Vec3(0.0, 0.0, 0.495)});  // within the slack
  EXPECT_TRUE(loss.woken(world, {}).empty());
  world.move(0, {.position = Vec3(0.02, 0.0, 0.495)});
  EXPECT_EQ(loss.woken(world, {}), std::vector<BodyIndex>{1});
}

TEST(SupportLoss, CountsTheMotionOfASupportOverAllTimesThatItIsAwake) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  world.freeze(std::vector<BodyIndex>{1});
  SupportLossRule loss;
  EXPECT_TRUE(loss.woken(world, stack_of_two()).empty());
  world.move(0, {.position = Vec3(0.0, 0.0, 0.493)});
  EXPECT_TRUE(loss.woken(world, {}).empty());
  world.freeze(std::vector<BodyIndex>{0});
  EXPECT_TRUE(loss.woken(world, {}).empty());
  world.thaw(std::vector<BodyIndex>{0});
  EXPECT_TRUE(loss.woken(world, {}).empty());
  world.move(0, {.position = Vec3(0.0, 0.0, 0.486)});
  EXPECT_EQ(loss.woken(world, {}), std::vector<BodyIndex>{1});
}

TEST(SupportLoss, CountsTheMotionOfASupportFromWhereTheBodyFellAsleep) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  world.freeze(std::vector<BodyIndex>{0});
  SupportLossRule loss;
  world.touching = {contact(1, 0, Vec3(0.0, 0.0, 1.0), Vec3::UnitZ(), 1.0)};
  loss.rule.note_falling_asleep(input(world), std::vector<BodyIndex>{1});
  world.freeze(std::vector<BodyIndex>{1});
  EXPECT_FALSE(loss.rule.watches(world, 1));
  world.thaw(std::vector<BodyIndex>{0});
  EXPECT_TRUE(loss.rule.watches(world, 1));
  world.move(0, {.position = Vec3(0.0, 0.0, 0.48)});  // before the two have touched again
  EXPECT_EQ(loss.woken(world, {}), std::vector<BodyIndex>{1});
}

TEST(SupportLoss, ForgetsTheSupportsOfABodyThatWakes) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  world.freeze(std::vector<BodyIndex>{1});
  SupportLossRule loss;
  EXPECT_TRUE(loss.woken(world, stack_of_two()).empty());
  loss.rule.note_awake(1);  // and sleeps again elsewhere
  world.move(0, {.position = Vec3(0.5, 0.0, 0.5)});
  EXPECT_TRUE(loss.woken(world, {}).empty());
}

TEST(SupportLoss, DoesNotWakeABodyOnWhichAnAwakeOneMoves) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 1.5), Vec3(0.0, 0.0, 0.5)});
  world.freeze(std::vector<BodyIndex>{1});
  SupportLossRule loss;
  const std::vector<Contact<3>> contacts = {contact(0, 1, Vec3(0.0, 0.0, 1.0), Vec3::UnitZ(), 1.0)};
  loss.woken(world, contacts);
  world.move(0, {.position = Vec3(0.5, 0.0, 1.5)});
  EXPECT_TRUE(loss.woken(world, contacts).empty());
}

TEST(SupportLoss, ForgetsASleeperThatIsRemoved) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  world.freeze(std::vector<BodyIndex>{1});
  SupportLossRule loss;
  loss.woken(world, stack_of_two());
  world.remove(1);
  world.move(0, {.position = Vec3(0.02, 0.0, 0.5)});
  EXPECT_TRUE(loss.woken(world, {}).empty()) << "what has left the world cannot wake";
}

/// An awake cube of 1 kg hits a sleeping one beside it and is stopped. It comes from the side `from`.
struct Collision {
  explicit Collision(const Vec3& side = -Vec3::UnitX())
      : from(side), world(cubes_at({middle() + side, middle()})), impacts(RuleParts{}.setup()) {
    world.freeze(std::vector<BodyIndex>{1});
    step();  // awake, without contact
    step();
  }
  void step() {
    const RuleInput<3> in = input(world, ++steps);
    out.clear();
    rest.update(in);
    impacts.update(in, rest, out);
  }
  static Vec3 middle() { return {0.0, 0.0, 5.0}; }
  void strike(double impulse, double approach, const Vec3& off_centre = Vec3::Zero()) {
    Contact<3> touch = contact(0, 1, middle() + 0.5 * from + off_centre, from, impulse);
    touch.approach_speed = approach;
    world.touching = {touch};
    step();
  }
  bool wakes() const { return !out.wakes.empty(); }
  Vec3 from;
  StillWorld<3> world;
  RestCriterion<3> rest{RuleParts{}.setup()};
  Impacts<3> impacts;
  RuleOutput<3> out;
  std::int64_t steps = 0;
};

TEST(Impacts, ShareMomentumAsBetweenFreeBodiesThatDoNotBounce) {
  Collision collision;
  collision.strike(4.0, 4.0);
  EXPECT_EQ(bodies_in(collision.out.wakes), std::vector<BodyIndex>{1});
  ASSERT_EQ(collision.out.velocities.size(), 2U);
  EXPECT_NEAR(collision.out.velocities[0].velocity[0], 2.0, 1e-12);  // equal masses: half of 4 m/s each
  EXPECT_NEAR(collision.out.velocities[1].velocity[0], 2.0, 1e-12);
}

TEST(Impacts, TooWeakToLiftTheSleepingBodyDoNotWakeIt) {
  Collision collision;
  collision.strike(0.5, 0.5);  // would give 0.25 m/s, enough to rise by 3 mm of the required 52 mm
  EXPECT_FALSE(collision.wakes());
  EXPECT_TRUE(collision.out.velocities.empty());
}

// 1.02 m/s lift a body by 0.03 D. Of equal masses each gets half of what stopped the awake one: here 1.1 m/s.
TEST(Impacts, CountByAThirdFromAboveAndByFiveThirdsFromBelow) {
  const auto wakes = [](const Vec3& from, double impulse) {
    Collision collision(from);
    collision.strike(impulse, 9.0);
    return collision.wakes();
  };
  EXPECT_TRUE(wakes(Vec3::UnitY(), 2.2));
  EXPECT_FALSE(wakes(Vec3::UnitZ(), 2.2));
  EXPECT_FALSE(wakes(Vec3::UnitZ(), 6.0));
  EXPECT_TRUE(wakes(Vec3::UnitZ(), 6.6));
  EXPECT_FALSE(wakes(-Vec3::UnitZ(), 1.2));
  EXPECT_TRUE(wakes(-Vec3::UnitZ(), 1.3));
}

// 0.4 m off the centre the struck point has 1 + 6 * 0.16 times the inverse mass of the centre.
TEST(Impacts, WakeByTheSpeedOfTheStruckPoint) {
  Collision central;
  central.strike(1.2, 9.0);
  EXPECT_FALSE(central.wakes());
  Collision off_centre;
  off_centre.strike(1.2, 9.0, 0.4 * Vec3::UnitY());
  EXPECT_TRUE(off_centre.wakes());
}

TEST(Impacts, AreOnlyWhatExceedsTheLoadOfTheStepBefore) {
  Collision collision;
  collision.strike(4.0, 4.0);
  collision.strike(4.0, 0.0);  // still the same load, as of a heap that leans against the sleeping body
  EXPECT_FALSE(collision.wakes());
}

TEST(Impacts, AreNotTheLoadUnderWhichABodyFallsAsleep) {
  for (const BodyIndex sleeper : {0, 1}) {
    Collision collision;
    collision.world.thaw(std::vector<BodyIndex>{1});
    collision.strike(4.0, 0.0);  // a load, under which nothing approaches
    collision.world.freeze(std::vector<BodyIndex>{sleeper});
    Contact<3>& touch = collision.world.touching[0];
    if (sleeper == 0) {
      std::swap(touch.a, touch.b);  // the awake body comes first
      touch.normal *= -1.0;
    }
    collision.step();
    EXPECT_FALSE(collision.wakes()) << sleeper;
  }
}

TEST(Impacts, GiveNoBodyMoreSpeedThanTheFastestApproachOfTheStep) {
  Collision collision;
  collision.strike(100.0, 3.0);  // an engine pushes overlapping bodies apart
  ASSERT_EQ(collision.out.velocities.size(), 2U);
  EXPECT_LE(collision.out.velocities[1].velocity.norm(), 3.0 + 1e-9);
}

// In a tenth of the gravity a tenth of the energy lifts the body as high.
TEST(Impacts, WakeByTheGravityOfTheStep) {
  Collision collision;
  collision.world.set_gravity(Vec3(0.0, 0.0, -1.0));
  collision.strike(0.7, 9.0);
  EXPECT_TRUE(collision.wakes()) << "0.35 m/s; it takes 0.32";
  Collision before;
  before.strike(0.7, 9.0);
  EXPECT_FALSE(before.wakes());
}

TEST(Impacts, OfABodyThatWokeAfterAPauseCountByItsApproach) {
  Collision collision;
  collision.steps += 100;  // all slept, so the rule was not called
  collision.strike(4.0, 0.0);
  EXPECT_FALSE(collision.wakes()) << "a load, not an impact";
}

/// A sleeping cube, an awake one that nearly touches it, and behind that a third one that pushes it.
struct PushedCube {
  PushedCube() { world.freeze(std::vector<BodyIndex>{0}); }
  /// The bodies that wake where the cube in the middle moves so and the third one pushes it along `push`.
  std::vector<BodyIndex> woken(const Vec3& velocity, const Vec3& spin, const Vec3& push) {
    world.push(1, velocity, spin);
    if (push != Vec3::Zero()) world.touching = {contact(1, 2, {-1.5, 0.0, 0.5}, push, 0.1)};
    RuleOutput<3> out;
    ImpactsAhead<3>(RuleParts{}.setup()).update(input(world), out);
    return bodies_in(out.wakes);
  }
  StillWorld<3> world = cubes_at({{0.0, 0.0, 0.5}, {-0.99, 0.0, 0.5}, {-2.0, 0.0, 0.5}});
};

const std::vector<BodyIndex> no_body;
const std::vector<BodyIndex> sleeping_cube = {0};

// A body wakes from 1.02 m/s on. Of equal masses the one that is hit gets half of the speed, here 1.5 m/s.
TEST(ImpactsAhead, WakeWhatABodyThatOthersPushIsAboutToHit) {
  EXPECT_EQ(PushedCube().woken(3.0 * Vec3::UnitX(), Vec3::Zero(), Vec3::UnitX()), sleeping_cube);
  EXPECT_EQ(PushedCube().woken(1.9 * Vec3::UnitX(), Vec3::Zero(), Vec3::UnitX()), no_body) << "too slow";
  EXPECT_EQ(PushedCube().woken(3.0 * Vec3::UnitX(), Vec3::Zero(), -Vec3::UnitX()), no_body) << "pushed back";
  EXPECT_EQ(PushedCube().woken(3.0 * Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()), no_body) << "by itself";
}

TEST(ImpactsAhead, WakeNoBodyThatTheMotionPassesBy) {
  EXPECT_EQ(PushedCube().woken(3.0 * Vec3::UnitY(), Vec3::Zero(), Vec3::UnitX()), no_body);
  EXPECT_EQ(PushedCube().woken(-3.0 * Vec3::UnitX(), Vec3::Zero(), Vec3::UnitX()), no_body);
}

// The corners are 0.87 m from the centre: at 3 rad/s they move at 2.6 m/s.
TEST(ImpactsAhead, CountTurningTowardsABodyAndNotAboutTheLineToIt) {
  EXPECT_EQ(PushedCube().woken(Vec3::Zero(), 3.0 * Vec3::UnitY(), Vec3::UnitX()), sleeping_cube);
  EXPECT_EQ(PushedCube().woken(Vec3::Zero(), 3.0 * Vec3::UnitX(), Vec3::UnitX()), no_body);
}

}  // namespace
}  // namespace talus::adaptive_rules_test
