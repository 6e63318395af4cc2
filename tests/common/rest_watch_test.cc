// How long bodies rest, and where.

#include "common/policy/rest_watch.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/common/cubes.h"

namespace talus::rest_watch_test {
namespace {

TEST(RestWatch, CountsFromWhereABodyCameToRestAndAnewWhenItStrays) {
  StillWorld<3> world = cubes_at({Vec3::Zero()});
  BodyStates<3> states = world.states();
  RestWatch<3> watch(0.01, 0.002, cubes().shapes);
  for (int step = 1; step <= 10; ++step) {
    states.pose[0].position[0] = 0.0005 * step;  // creeps, but within the distance
    watch.update(step, states, world.awake());
  }
  EXPECT_EQ(watch.steps_at_rest(10, 0), 9);
  states.pose[0].position[0] = 0.02;
  watch.update(11, states, world.awake());
  EXPECT_EQ(watch.steps_at_rest(11, 0), 0);
}

TEST(RestWatch, SeesABodyThatOnlyTurns) {
  StillWorld<3> world = cubes_at({Vec3::Zero()});
  BodyStates<3> states = world.states();
  RestWatch<3> watch(0.01, 0.002, cubes().shapes);
  watch.update(1, states, world.awake());
  states.pose[0].rotation = Eigen::AngleAxisd(0.02, Vec3::UnitZ());  // a corner goes 0.017 m
  watch.update(2, states, world.awake());
  EXPECT_EQ(watch.steps_at_rest(2, 0), 0);
}

TEST(RestWatch, BeginsAnewForABodyThatSleptInBetween) {
  StillWorld<3> world = cubes_at({Vec3::Zero()});
  RestWatch<3> watch(0.01, 0.002, cubes().shapes);
  watch.update(1, world.states(), world.awake());
  watch.update(5, world.states(), world.awake());
  EXPECT_EQ(watch.steps_at_rest(5, 0), 0);
}

TEST(RestWatch, KnowsWhoWokeWhereItRestsUntilItStrays) {
  StillWorld<3> world = cubes_at({Vec3::Zero(), Vec3(5.0, 0.0, 0.0)});
  BodyStates<3> states = world.states();
  const BodyIndex first = 0;
  RestWatch<3> watch(0.01, 0.002, cubes().shapes);
  watch.update(1, states, world.awake());
  EXPECT_FALSE(watch.slept_here(first));  // it is new
  world.freeze({&first, 1});
  watch.update(2, states, world.awake());
  world.thaw({&first, 1});
  watch.update(3, states, world.awake());
  EXPECT_TRUE(watch.slept_here(first));
  EXPECT_FALSE(watch.slept_here(1));  // it never slept
  states.pose[0].position[0] = 0.001;
  watch.update(4, states, world.awake());
  EXPECT_TRUE(watch.slept_here(first));
  states.pose[0].position[0] = 0.003;  // it gives way, if slowly: its rest goes on, but has to last like any other
  watch.update(5, states, world.awake());
  EXPECT_FALSE(watch.slept_here(first));
  EXPECT_EQ(watch.steps_at_rest(5, first), 2);
  states.pose[0].position[0] = 0.0;
  watch.update(6, states, world.awake());
  EXPECT_FALSE(watch.slept_here(first));
}

TEST(RestWatch, DoesNotTakeForRestedWhoWokeForWhatIsToCome) {
  StillWorld<3> world = cubes_at({Vec3::Zero()});
  const std::vector<BodyIndex> all = {0};
  RestWatch<3> watch(0.01, 0.002, cubes().shapes);
  watch.update(1, world.states(), world.awake());
  world.freeze(all);
  watch.update(2, world.states(), world.awake());
  watch.expect_to_move(all);
  world.thaw(all);
  watch.update(3, world.states(), world.awake());
  EXPECT_FALSE(watch.slept_here(0));
}

}  // namespace
}  // namespace talus::rest_watch_test
