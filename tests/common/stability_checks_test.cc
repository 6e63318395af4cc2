// When the policy `adaptive` wakes a region to see whether it stays where it is.

#include "common/policy/wake_rules/stability_checks.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/common/adaptive_rules.h"

namespace talus::stability_checks_test {
namespace {

/// Cubes of 1 m that lie where they are put, and the rule with D = 1 m and g = 1 m/s^2, so that sqrt(D / g) is a second
/// of 60 steps and columns are 4 m wide. The tolerance is 0.05 m. The friction of the first shape is 0.5, of the second
/// 0.1.
class StabilityChecksTest : public testing::Test {
 protected:
  static constexpr int sample_time = 48;  // steps between two samples of the displacement
  static constexpr int check_time = 144;  // steps within which a check of still bodies is over

  static RuleParts parts() {
    RuleParts parts{.extent = 1.0};
    parts.params.tolerance = 0.05;
    parts.world.gravity = 1.0;
    parts.world.shapes.push_back(parts.world.shapes.front());
    parts.world.shapes.back().material.friction = 0.1;
    return parts;
  }
  StabilityChecksTest() : world_(parts().world), rest_(parts().setup()), checks_(parts().setup()) {}

  BodyIndex add(double x, double height = 0.5, int shape = 0) {
    return world_.add({.shape = shape, .pose = {.position = Vec3(x, 2.0, height)}});
  }

  void put_to_sleep(const std::vector<BodyIndex>& bodies) {
    world_.freeze(bodies);
    for (const BodyIndex body : bodies)
      sleepers_.put_in(body, world_.states().pose[body].position, checks_.note_asleep(world_, body));
  }
  void wake(const std::vector<BodyIndex>& bodies) {
    world_.thaw(bodies);
    for (const BodyIndex body : bodies) sleepers_.take_out(body);
  }
  bool may_begin() const { return checks_.may_begin(sleepers_); }

  /// One step; returns the bodies that wake.
  std::vector<BodyIndex> step() {
    const RuleInput<3> in = input(world_, ++step_, piles_);
    RuleOutput<3> out;
    rest_.update(in);
    checks_.update(in, rest_, sleepers_, out);
    std::vector<BodyIndex> woken = bodies_in(out.wakes);
    wake(woken);
    return woken;
  }

  /// The bodies that wake within so many steps; `each` is called before each step.
  template <typename Each>
  std::vector<BodyIndex> steps(int count, Each each) {
    std::vector<BodyIndex> woken;
    for (int i = 0; i < count; ++i) {
      each();
      const std::vector<BodyIndex> now = step();
      woken.insert(woken.end(), now.begin(), now.end());
    }
    return woken;
  }
  std::vector<BodyIndex> steps(int count) {
    return steps(count, [] {});
  }

  /// Moves a body by so much along x [m].
  void move(BodyIndex body, double distance) {
    Pose<3> pose = world_.states().pose[body];
    pose.position.x() += distance;
    world_.move(body, pose);
  }

  StillWorld<3> world_;
  RestCriterion<3> rest_;
  StabilityChecks<3> checks_;
  SleepLedger<3> sleepers_{4.0};
  std::vector<Pile<3>> piles_;
  std::int64_t step_ = 0;
};

TEST_F(StabilityChecksTest, WakeAQuietRegionAndHoldItUntilItHasLainStill) {
  const std::vector<BodyIndex> bodies = {add(1.0), add(2.0)};
  put_to_sleep(bodies);
  EXPECT_TRUE(may_begin());
  EXPECT_EQ(steps(sample_time), bodies);
  EXPECT_FALSE(may_begin());
  EXPECT_TRUE(checks_.holds(0) && checks_.holds(1));
  steps(check_time);
  EXPECT_FALSE(checks_.holds(0) || checks_.holds(1));
}

// The tolerance of 0.05 m within the horizon of 13 s is a speed of 0.0038 m/s.
TEST_F(StabilityChecksTest, HoldABodyForAsLongAsItMoves) {
  put_to_sleep({add(1.0)});
  steps(sample_time);
  steps(600, [&] { move(0, 1.1 * 0.0038 / 60.0); });
  EXPECT_TRUE(checks_.holds(0));
  steps(check_time, [&] { move(0, 0.9 * 0.0038 / 60.0); });
  EXPECT_FALSE(checks_.holds(0));
}

// Within the horizon of 6 s, which holds for motion that slows down, it is a speed of 0.0083 m/s.
TEST_F(StabilityChecksTest, ReleaseABodySoonerThatSlowsDown) {
  put_to_sleep({add(1.0)});
  steps(sample_time);
  steps(25 * sample_time, [&] { move(0, 0.9 * 0.0083 / 60.0); });
  EXPECT_TRUE(checks_.holds(0)) << "at an even speed";
  steps(sample_time, [&] { move(0, 1.8 * 0.0083 / 60.0); });
  steps(sample_time, [&] { move(0, 0.9 * 0.0083 / 60.0); });
  EXPECT_FALSE(checks_.holds(0)) << "at half the speed before";
}

TEST_F(StabilityChecksTest, ReleaseWhatLiesStillFarFromWhatMoves) {
  // In one column of 4 m, but with a block of 2.5 m between their blocks.
  put_to_sleep({add(0.5, 0.5), add(0.5, 9.5)});
  steps(sample_time + check_time, [&] {
    if (checks_.holds(1)) move(1, 0.001);
  });
  EXPECT_FALSE(checks_.holds(0));
  EXPECT_TRUE(checks_.holds(1));
}

TEST_F(StabilityChecksTest, EndAfterAMinuteOfTheirTimeWhateverMoves) {
  put_to_sleep({add(1.0)});
  steps(sample_time);
  steps(61 * 60, [&] { move(0, world_.states().pose[0].position.x() > 2.0 ? -0.01 : 0.01); });
  EXPECT_FALSE(checks_.holds(0)) << "contacts of an engine may jitter for ever";
}

TEST_F(StabilityChecksTest, AreNotRepeatedForABodyThatSleepsAgainWhereItWas) {
  put_to_sleep({add(1.0)});
  steps(sample_time + check_time);
  move(0, 0.04);
  put_to_sleep({0});
  EXPECT_FALSE(may_begin());
  wake({0});
  move(0, 0.02);  // 0.06 m from where the check left it
  put_to_sleep({0});
  EXPECT_TRUE(may_begin());
  EXPECT_EQ(steps(sample_time), (std::vector<BodyIndex>{0}));
}

TEST_F(StabilityChecksTest, WakeTheColumnsAroundAndNoneFarther) {
  const BodyIndex checked = add(6.0);
  put_to_sleep({checked});
  steps(sample_time + check_time);
  const BodyIndex far = add(-6.0);
  put_to_sleep({far});
  steps(sample_time + check_time);
  put_to_sleep({checked, far});
  EXPECT_FALSE(may_begin()) << "both lie where a check left them";
  const BodyIndex fresh = add(1.0);  // in the column from 0 to 4 m, the others from 4 m up and below -4 m
  put_to_sleep({fresh});
  EXPECT_EQ(steps(sample_time), (std::vector<BodyIndex>{checked, fresh}));
}

// The regions of bodies 1 and 2 overlap in the column between them, whose body is settled.
TEST_F(StabilityChecksTest, OfRegionsThatShareAColumnBeginOneAfterTheOther) {
  put_to_sleep({add(6.0)});
  steps(sample_time + check_time);
  put_to_sleep({0});
  put_to_sleep({add(2.0), add(10.0)});
  EXPECT_EQ(steps(sample_time), (std::vector<BodyIndex>{0, 1}));
  EXPECT_FALSE(checks_.holds(2));
  EXPECT_EQ(steps(check_time + sample_time), std::vector<BodyIndex>{2});
}

TEST_F(StabilityChecksTest, WaitWhileABodyMovesOnTheRegion) {
  put_to_sleep({add(1.0)});
  const BodyIndex rolling = add(1.0, 1.5);
  world_.touching = {contact(0, rolling, Vec3(1.0, 2.0, 1.0), -Vec3::UnitZ(), 0.1)};
  const auto roll = [&] { move(rolling, step_ % 2 == 0 ? 0.1 : -0.1); };
  EXPECT_TRUE(steps(300, roll).empty());
  EXPECT_EQ(steps(60), (std::vector<BodyIndex>{0})) << "once it rests";
}

TEST_F(StabilityChecksTest, AllowSomeMotionOnceNoBodyIsOnItsWay) {
  std::vector<BodyIndex> heap;
  for (int i = 0; i < 20; ++i) heap.push_back(add(0.1 + 0.1 * i));
  put_to_sleep(heap);
  const BodyIndex rolling = add(1.0, 1.5);
  const BodyIndex flying = add(1.0, 50.0);
  const std::vector<Contact<3>> on_heap = {contact(0, rolling, Vec3(1.0, 2.0, 1.0), -Vec3::UnitZ(), 0.1)};
  world_.touching = on_heap;
  const auto roll = [&] { move(rolling, step_ % 2 == 0 ? 0.1 : -0.1); };
  EXPECT_TRUE(steps(600, roll).empty()) << "a body is on its way";
  world_.touching.push_back(contact(flying, ground_index, Vec3::Zero(), Vec3::UnitZ(), 0.1));
  EXPECT_EQ(steps(600, roll), heap) << "one in twenty may move";
}

TEST_F(StabilityChecksTest, WaitForAFifthOfARegionWhileBodiesArrive) {
  const BodyIndex flying = add(1.0, 50.0);
  std::vector<BodyIndex> heap;
  for (int i = 0; i < 9; ++i) heap.push_back(add(0.1 + 0.1 * i));
  put_to_sleep(heap);
  EXPECT_EQ(steps(sample_time), heap);
  steps(check_time);
  put_to_sleep(heap);
  const BodyIndex first = add(1.2);
  put_to_sleep({first});
  EXPECT_TRUE(steps(600).empty()) << "one of ten is unchecked";
  const BodyIndex second = add(1.3);
  const BodyIndex third = add(1.4);
  put_to_sleep({second, third});
  heap.insert(heap.end(), {first, second, third});
  EXPECT_EQ(steps(sample_time), heap) << "three of twelve are";
  EXPECT_FALSE(checks_.holds(flying));
}

TEST_F(StabilityChecksTest, DoNotWaitForFurtherBodiesOnceNoneArrives) {
  std::vector<BodyIndex> heap;
  for (int i = 0; i < 9; ++i) heap.push_back(add(0.1 + 0.1 * i));
  put_to_sleep(heap);
  steps(sample_time + check_time);
  put_to_sleep(heap);
  heap.push_back(add(1.2));
  put_to_sleep({heap.back()});
  EXPECT_EQ(steps(9 * 60), heap);
}

TEST_F(StabilityChecksTest, LeaveFewerThanATwentiethOfARegionUnchecked) {
  std::vector<BodyIndex> heap;
  for (int i = 0; i < 20; ++i) heap.push_back(add(0.1 + 0.1 * i));
  put_to_sleep(heap);
  steps(sample_time + check_time);
  put_to_sleep(heap);
  put_to_sleep({add(2.5)});
  EXPECT_TRUE(steps(20 * 60).empty()) << "one of 21";
  EXPECT_FALSE(may_begin()) << "so that a pile at rest costs nothing";
  put_to_sleep({add(2.7)});
  EXPECT_EQ(steps(sample_time).size(), 22U) << "two of 22";
}

/// A region of two columns, 4 m apart, on which a body rolls; bodies are expected to arrive.
class LoadedRegion : public StabilityChecksTest {
 protected:
  void make(double rise, int shape = 0) {
    put_to_sleep({add(1.0, 0.5), add(5.0, 0.5 + rise, shape)});
    rolling_ = add(1.0, 1.5);
    world_.touching = {contact(0, rolling_, Vec3(1.0, 2.0, 1.0), -Vec3::UnitZ(), 0.1)};
  }
  void roll() { move(rolling_, step_ % 2 == 0 ? 0.1 : -0.1); }

  BodyIndex rolling_ = 0;
};

// In 3D the slope counts as the same along both axes: 1.15 * 0.5 is a rise of 1.63 m over 4 m.
TEST_F(LoadedRegion, IsCheckedAlthoughItMovesWhereItIsSteeperThanItsFriction) {
  make(1.7);
  EXPECT_EQ(steps(sample_time, [&] { roll(); }), (std::vector<BodyIndex>{0, 1}));
}

TEST_F(LoadedRegion, IsLeftAloneWhereItIsFlatter) {
  make(1.5);
  EXPECT_TRUE(steps(7 * 60, [&] { roll(); }).empty()) << "no body of low friction lies in it";
}

TEST_F(LoadedRegion, IsAsSteepAsTheLowestFrictionInItHolds) {
  make(1.5, 1);
  EXPECT_EQ(steps(sample_time, [&] { roll(); }), (std::vector<BodyIndex>{0, 1}));
}

TEST_F(LoadedRegion, IsHeldForAShortTimeAndCheckedAgainOnceItIsQuiet) {
  make(1.7);
  const auto slide = [&] {
    roll();
    for (const BodyIndex body : {0, 1})
      if (checks_.holds(body)) move(body, 0.001);
  };
  steps(sample_time, slide);
  steps(2 * sample_time, slide);
  EXPECT_TRUE(checks_.holds(0));
  steps(sample_time, slide);
  EXPECT_FALSE(checks_.holds(0)) << "after three samples, whatever moves";
  put_to_sleep({0, 1});
  EXPECT_TRUE(may_begin()) << "such a check proves nothing";
  EXPECT_TRUE(steps(2 * sample_time, slide).empty()) << "nothing is new";
  EXPECT_EQ(steps(2 * sample_time), (std::vector<BodyIndex>{0, 1})) << "once it is quiet";
}

TEST_F(StabilityChecksTest, GoOnWhenABodyUnderCheckIsRemoved) {
  put_to_sleep({add(1.0), add(2.0)});
  steps(sample_time);
  world_.remove(0);
  steps(check_time);
  EXPECT_FALSE(checks_.holds(1));
}

TEST_F(StabilityChecksTest, EstimateNoDriftOfABodyThatLayStill) {
  put_to_sleep({add(1.0)});
  EXPECT_FALSE(checks_.drift_estimate(world_)) << "before the first check nothing is known";
  steps(sample_time + check_time);
  put_to_sleep({0});
  EXPECT_EQ(checks_.drift_estimate(world_)->checked_share, 1.0);
  EXPECT_EQ(checks_.drift_estimate(world_)->drift, 0.0);
}

// sqrt(D/g) is 1 s; the estimate is the distance moved in 1.5 s at that speed.
TEST_F(StabilityChecksTest, EstimateTheDriftFromTheSpeedAtWhichTheyLeaveABody) {
  put_to_sleep({add(1.0)});
  steps(sample_time);
  steps(check_time, [&] { move(0, 0.9 * 0.0038 / 60.0); });
  put_to_sleep({0});
  EXPECT_NEAR(checks_.drift_estimate(world_)->drift, 1.5 * 0.9 * 0.0038, 1.5e-4);
}

TEST_F(StabilityChecksTest, EstimateTheDriftOfUncheckedBodiesFromTheMotionOfThoseThatWereChecked) {
  put_to_sleep({add(1.0)});
  steps(sample_time);
  double moved = 0.0;
  steps(check_time, [&] {
    const double distance = checks_.holds(0) ? 0.9 * 0.0038 / 60.0 : 0.0;
    move(0, distance);
    moved += distance;
  });
  put_to_sleep({add(100.0)});
  EXPECT_NEAR(checks_.drift_estimate(world_)->drift, moved, 1e-9);
}

TEST_F(StabilityChecksTest, EstimateNothingWhileMoreThanATwentiethOfTheBodiesIsAwakeInContact) {
  std::vector<BodyIndex> heap;
  for (int i = 0; i < 20; ++i) heap.push_back(add(0.1 + 0.1 * i));
  put_to_sleep(heap);
  steps(sample_time + check_time);
  put_to_sleep(heap);
  const BodyIndex first = add(1.0, 1.5);
  const BodyIndex second = add(2.0, 1.5);
  world_.record_contacts(true);
  world_.step();
  EXPECT_TRUE(checks_.drift_estimate(world_)) << "both are in flight";
  world_.touching = {contact(0, first, Vec3(1.0, 2.0, 1.0), -Vec3::UnitZ(), 0.1)};
  world_.step();
  EXPECT_TRUE(checks_.drift_estimate(world_)) << "one of 21 bodies is awake in contact";
  world_.touching.push_back(contact(0, second, Vec3(2.0, 2.0, 1.0), -Vec3::UnitZ(), 0.1));
  world_.step();
  EXPECT_FALSE(checks_.drift_estimate(world_)) << "two of 22 are";
  put_to_sleep({second});
  EXPECT_TRUE(checks_.drift_estimate(world_)) << "one of them sleeps";
}

TEST(StabilityChecks, AreOffWithoutATolerance) {
  StillWorld<3> world(cubes());
  RuleParts parts;
  parts.params.tolerance = 0.0;
  StabilityChecks<3> checks(parts.setup());
  world.add({.pose = {.position = Vec3(0.0, 0.0, 0.5)}});
  world.freeze(std::vector<BodyIndex>{0});
  EXPECT_EQ(checks.note_asleep(world, 0), Standing::settled);
  EXPECT_FALSE(checks.drift_estimate(world));
}

}  // namespace
}  // namespace talus::stability_checks_test
