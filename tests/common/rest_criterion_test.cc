// How long bodies have been at rest, and where.

#include "common/policy/rest/rest_criterion.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/common/adaptive_rules.h"

namespace talus::rest_criterion_test {
namespace {

/// With D = 1 m: rest within 0.01 m, and unmoved within 0.002 m.
class RestCriterionTest : public testing::Test {
 protected:
  RestCriterionTest() : rest_(RuleParts{.extent = 1.0}.setup()) {}

  void update(std::int64_t step) { rest_.update(input(world_, step)); }
  void move_first_to(double x) { world_.move(0, {.position = Vec3(x, 0.0, 0.0)}); }
  double steps_at_rest(BodyIndex body) const { return rest_.time_at_rest(body) / cubes().dt; }

  StillWorld<3> world_ = cubes_at({Vec3::Zero(), Vec3(5.0, 0.0, 0.0)});
  RestCriterion<3> rest_;
  std::vector<BodyIndex> first_ = {0};
};

TEST_F(RestCriterionTest, CountsFromWhereABodyCameToRestAndBeginsAgainWhenItMoves) {
  for (int step = 1; step <= 10; ++step) {
    move_first_to(0.0005 * step);  // creeps, but within the distance
    update(step);
  }
  EXPECT_NEAR(steps_at_rest(0), 9.0, 1e-9);
  move_first_to(0.02);
  update(11);
  EXPECT_EQ(steps_at_rest(0), 0.0);
}

TEST_F(RestCriterionTest, SeesABodyThatOnlyTurns) {
  update(1);
  const Rotation<3> turned(Eigen::AngleAxisd(0.02, Vec3::UnitZ()));  // a corner moves by 0.017 m
  world_.move(0, {.rotation = turned});
  update(2);
  EXPECT_EQ(steps_at_rest(0), 0.0);
}

TEST_F(RestCriterionTest, BeginsAgainAfterStepsInWhichAllBodiesSlept) {
  update(1);
  update(5);
  EXPECT_EQ(steps_at_rest(0), 0.0);
}

TEST_F(RestCriterionTest, MarksABodyThatWokeAsUnmovedUntilItMoves) {
  update(1);
  EXPECT_FALSE(rest_.unmoved_since_wake(0));  // it is new
  world_.freeze(first_);
  update(2);
  world_.thaw(first_);
  update(3);
  EXPECT_TRUE(rest_.unmoved_since_wake(0));
  EXPECT_FALSE(rest_.unmoved_since_wake(1));  // it never slept
  move_first_to(0.001);
  update(4);
  EXPECT_TRUE(rest_.unmoved_since_wake(0));
  move_first_to(0.003);  // gives way slowly: its rest goes on, but has to last like any other
  update(5);
  EXPECT_FALSE(rest_.unmoved_since_wake(0));
  EXPECT_NEAR(steps_at_rest(0), 2.0, 1e-9);
  move_first_to(0.0);
  update(6);
  EXPECT_FALSE(rest_.unmoved_since_wake(0));
}

TEST_F(RestCriterionTest, DoesNotMarkABodyThatWokeBeforeAnImpact) {
  update(1);
  world_.freeze(first_);
  update(2);
  WakeList wakes;
  wakes.try_emplace(0, Wake{.cause = SleepCause::momentum, .before_impact = true});
  rest_.expect_motion(wakes);
  world_.thaw(first_);
  update(3);
  EXPECT_FALSE(rest_.unmoved_since_wake(0));
}

// The default tolerance of 0.05 D goes with a rest distance of 0.01 D.
TEST(RestDistances, ShrinkWithAToleranceBelowTheDefaultAndDoNotGrowWithOneAbove) {
  const auto factor = [](double tolerance) { return AdaptiveParams{.tolerance = tolerance}.rest_distance_factor(); };
  EXPECT_EQ(factor(AdaptiveParams{}.tolerance), 1.0);
  EXPECT_DOUBLE_EQ(factor(0.01), 0.2);
  EXPECT_EQ(factor(0.2), 1.0);
  EXPECT_EQ(factor(0.0), 1.0) << "no checks";
}

TEST(RestDistances, OfASmallToleranceCallASlowerCreepMotion) {
  const auto at_rest_after_creep = [](double tolerance) {
    RuleParts parts;
    parts.params.tolerance = tolerance;
    StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5)});
    RestCriterion<3> rest(parts.setup());
    rest.update(input(world, 1));
    world.move(0, {.position = Vec3(0.005 * parts.extent, 0.0, 0.5)});
    rest.update(input(world, 2));
    return rest.time_at_rest(0) > 0.0;
  };
  EXPECT_TRUE(at_rest_after_creep(0.05));
  EXPECT_FALSE(at_rest_after_creep(0.02));
}

}  // namespace
}  // namespace talus::rest_criterion_test
