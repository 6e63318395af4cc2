// The parts of the policy `adaptive`, each on contacts made up for it.

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <vector>

#include "common/policy/bearing.h"
#include "common/policy/blows.h"
#include "common/policy/impulse.h"
#include "common/policy/props.h"
#include "common/simulation/simulation.h"
#include "tests/common/cubes.h"

namespace talus::adaptive_rules_test {
namespace {

Contact<3> contact(BodyIndex a, BodyIndex b, const Vec3& point, const Vec3& normal, double impulse) {
  return {.a = a, .b = b, .point = point, .normal = normal, .normal_impulse = impulse};
}

TEST(Impulse, MovesABodyAtItsCentreByItsMassAlone) {
  const Shape<3> cube = cubes().shapes.front();
  EXPECT_DOUBLE_EQ(yielding<3>(cube, {}, Vec3::Zero(), Vec3::UnitX()), 1.0);
}

TEST(Impulse, TurnsABodyThatItMeetsOffCentre) {
  const Shape<3> cube = cubes().shapes.front();
  const Pose<3> pose{.position = Vec3(1.0, 2.0, 3.0)};
  const Vec3 place = pose.position + Vec3(0.0, 0.0, 0.5);
  // 1/m + l^2/I = 1 + 0.25 * 6
  EXPECT_NEAR(yielding<3>(cube, pose, place, Vec3::UnitX()), 2.5, 1e-12);
  Vec3 velocity = Vec3::Zero();
  Spin<3> spin = Spin<3>::Zero();
  push<3>(cube, pose, place, 2.0 * Vec3::UnitX(), velocity, spin);
  EXPECT_NEAR((velocity - Vec3(2.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((spin - Vec3(0.0, 6.0, 0.0)).norm(), 0.0, 1e-12);  // l J / I about y
}

/// Cube 1 on cube 0 on the ground, each weighing 1 N s a step.
std::vector<Contact<3>> stack_of_two() {
  return {contact(0, ground_index, Vec3::Zero(), Vec3::UnitZ(), 2.0),
          contact(0, 1, Vec3(0.0, 0.0, 1.0), -Vec3::UnitZ(), 1.0)};
}

TEST(Bearing, KeepsAStackThatRestsAsAWhole) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  std::vector<BodyIndex> candidates = {0, 1};
  keep_borne<3>(stack_of_two(), world.states(), std::vector{1.0}, 0.25, candidates);
  EXPECT_EQ(candidates, (std::vector<BodyIndex>{0, 1}));
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

TEST(Bearing, LeavesOutABodyThatLiesOnOneWhichStaysAwake) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  std::vector<BodyIndex> candidates = {1};
  keep_borne<3>(stack_of_two(), world.states(), std::vector{1.0}, 0.25, candidates);
  EXPECT_TRUE(candidates.empty());
}

TEST(Bearing, LeavesOutAWholeTowerWhoseFootIsLeftOut) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5), Vec3(0.0, 0.0, 2.5)});
  std::vector<BodyIndex> candidates = {0, 1, 2};
  // Nothing bears the lowest: it falls, and the others with it.
  const std::vector<Contact<3>> contacts = {contact(0, 1, Vec3(0.0, 0.0, 1.0), -Vec3::UnitZ(), 1.0),
                                            contact(1, 2, Vec3(0.0, 0.0, 2.0), -Vec3::UnitZ(), 1.0)};
  keep_borne<3>(contacts, world.states(), std::vector{1.0}, 0.25, candidates);
  EXPECT_TRUE(candidates.empty());
}

TEST(Bearing, LeavesOutABodyInFlight) {
  const StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 5.0)});
  std::vector<BodyIndex> candidates = {0};
  keep_borne<3>({}, world.states(), std::vector{1.0}, 0.25, candidates);
  EXPECT_TRUE(candidates.empty());
}

TEST(Props, TellASleeperWhoseSupportWentAway) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.0, 1.5)});
  world.freeze(std::vector<BodyIndex>{1});
  BodyStates<3> states = world.states();
  Props<3> props(0.01);
  std::vector<BodyIndex> left;
  props.update(stack_of_two(), states, left);
  EXPECT_TRUE(left.empty());
  states.pose[0].position[2] -= 0.005;  // within the slack
  props.update({}, states, left);
  EXPECT_TRUE(left.empty());
  states.pose[0].position[0] += 0.02;
  props.update({}, states, left);
  EXPECT_EQ(left, std::vector<BodyIndex>{1});
}

TEST(Props, DoNotTellASleeperOnWhichAnAwakeBodyMoves) {
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 1.5), Vec3(0.0, 0.0, 0.5)});
  world.freeze(std::vector<BodyIndex>{1});
  BodyStates<3> states = world.states();
  Props<3> props(0.01);
  std::vector<BodyIndex> left;
  const std::vector<Contact<3>> contacts = {contact(0, 1, Vec3(0.0, 0.0, 1.0), Vec3::UnitZ(), 1.0)};
  props.update(contacts, states, left);
  states.pose[0].position[0] += 0.5;
  props.update(contacts, states, left);
  EXPECT_TRUE(left.empty());
}

/// An awake cube of 1 kg that hit the sleeping one beside it, which stopped it. It comes from the side that `from`
/// names.
struct Struck {
  explicit Struck(const Vec3& side = -Vec3::UnitX())
      : from(side), world(cubes_at({middle() + side, middle()})), blows({}, std::sqrt(3.0), cubes()) {
    world.freeze(std::vector<BodyIndex>{1});
    blows.update(world, {}, hit, kicks);  // the step before: awake, without contact
    hit.clear();
    kicks.clear();
  }
  static Vec3 middle() { return {0.0, 0.0, 5.0}; }
  void strike(double impulse, double approach, const Vec3& off_centre = Vec3::Zero()) {
    Contact<3> touch = contact(0, 1, middle() + 0.5 * from + off_centre, from, impulse);
    touch.approach_speed = approach;
    blows.update(world, std::vector{touch}, hit, kicks);
  }
  bool wakes() const { return !hit.empty(); }
  Vec3 from;
  StillWorld<3> world;
  Blows<3> blows;
  std::vector<BodyIndex> hit;
  std::vector<Kick<3>> kicks;
};

TEST(Blow, SharesItsMomentumAsBetweenFreeBodiesThatDoNotBounce) {
  Struck blow;
  blow.strike(4.0, 4.0);
  EXPECT_EQ(blow.hit, std::vector<BodyIndex>{1});
  ASSERT_EQ(blow.kicks.size(), 2U);
  EXPECT_NEAR(blow.kicks[0].velocity[0], 2.0, 1e-12);  // equal masses: half of 4 m/s each
  EXPECT_NEAR(blow.kicks[1].velocity[0], 2.0, 1e-12);
}

TEST(Blow, TooWeakToLiftTheSleeperWakesNobody) {
  Struck blow;
  blow.strike(0.5, 0.5);  // would give 0.25 m/s, enough to rise by 3 mm of the 52 mm that count
  EXPECT_TRUE(blow.hit.empty());
  EXPECT_TRUE(blow.kicks.empty());
}

// 1.02 m/s lift a body by 0.03 D. Of equal masses each gets half of what stopped the striker: here 1.1 m/s.
TEST(Blow, CountsAThirdFromAboveAndFiveThirdsFromBelow) {
  const auto wakes = [](const Vec3& from, double impulse) {
    Struck blow(from);
    blow.strike(impulse, 9.0);
    return blow.wakes();
  };
  EXPECT_TRUE(wakes(Vec3::UnitY(), 2.2));
  EXPECT_FALSE(wakes(Vec3::UnitZ(), 2.2));
  EXPECT_FALSE(wakes(Vec3::UnitZ(), 6.0));
  EXPECT_TRUE(wakes(Vec3::UnitZ(), 6.6));
  EXPECT_FALSE(wakes(-Vec3::UnitZ(), 1.2));
  EXPECT_TRUE(wakes(-Vec3::UnitZ(), 1.3));
}

// 0.4 m off the centre the point struck yields 1 + 6 * 0.16 times as much as the whole.
TEST(Blow, WakesBySpeedOfThePointThatIsStruck) {
  Struck central;
  central.strike(1.2, 9.0);
  EXPECT_FALSE(central.wakes());
  Struck off_centre;
  off_centre.strike(1.2, 9.0, 0.4 * Vec3::UnitY());
  EXPECT_TRUE(off_centre.wakes());
}

TEST(Blow, IsOnlyWhatComesOnTopOfTheLoadOfTheStepBefore) {
  Struck blow;
  blow.strike(4.0, 4.0);
  blow.hit.clear();
  blow.strike(4.0, 0.0);  // still the same load, as of a heap that leans against the sleeper
  EXPECT_TRUE(blow.hit.empty());
}

TEST(Blow, GivesNobodyMoreSpeedThanTheFastestApproachOfTheStep) {
  Struck blow;
  blow.strike(100.0, 3.0);  // an engine pushes bodies apart that overlap
  ASSERT_EQ(blow.kicks.size(), 2U);
  EXPECT_LE(blow.kicks[1].velocity.norm(), 3.0 + 1e-9);
}

}  // namespace
}  // namespace talus::adaptive_rules_test
