// The account of sleeping bodies that the policy `adaptive` keeps.

#include "common/policy/wake_rules/sleep_ledger.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "tests/common/cubes.h"

namespace talus::sleep_ledger_test {
namespace {

using Column = SleepLedger<3>::Column;

/// Three cubes that sleep, two in the column from 0 to 4 m and one beside it.
struct ThreeSleepers {
  ThreeSleepers() {
    world.freeze(std::vector<BodyIndex>{0, 1, 2});
    put_in(0, Standing::fresh);
    put_in(1, Standing::unchecked);
    put_in(2, Standing::settled);
  }
  void put_in(BodyIndex body, Standing standing) { ledger.put_in(body, world.states().pose[body].position, standing); }
  StillWorld<3> world = cubes_at({Vec3(1.0, 1.0, 0.5), Vec3(3.0, 1.0, 0.5), Vec3(5.0, 1.0, 0.5)});
  SleepLedger<3> ledger{4.0};
};

TEST(SleepLedger, CountsSleepersByColumnAndThoseThatWaitForACheck) {
  ThreeSleepers three;
  EXPECT_EQ(three.ledger.count({0, 0}), (SleepLedger<3>::Count{.sleeping = 2, .unchecked = 2, .fresh = 1}));
  EXPECT_EQ(three.ledger.count({1, 0}), (SleepLedger<3>::Count{.sleeping = 1}));
  EXPECT_EQ(three.ledger.unchecked(), 2);
  EXPECT_TRUE(three.ledger.matches(three.world.states()));
}

TEST(SleepLedger, TakesABodyOutOfTheColumnIntoWhichItWasPut) {
  ThreeSleepers three;
  three.world.move(0, {.position = Vec3(5.0, 1.0, 0.5)});
  three.ledger.take_out(0);
  EXPECT_EQ(three.ledger.count({0, 0}), (SleepLedger<3>::Count{.sleeping = 1, .unchecked = 1}));
  EXPECT_EQ(three.ledger.count({1, 0}).sleeping, 1);
}

TEST(SleepLedger, CountsABodyOnceHoweverOftenItIsTold) {
  ThreeSleepers three;
  three.put_in(0, Standing::fresh);
  EXPECT_EQ(three.ledger.count({0, 0}).sleeping, 2);
  three.ledger.take_out(2);
  three.ledger.take_out(2);
  three.ledger.take_out(9);
  EXPECT_FALSE(three.ledger.counts().contains({1, 0}));
}

TEST(SleepLedger, MatchesNoWorldInWhichAnotherBodySleepsOrLiesElsewhere) {
  ThreeSleepers three;
  three.world.thaw(std::vector<BodyIndex>{1});
  EXPECT_FALSE(three.ledger.matches(three.world.states()));
  three.ledger.take_out(1);
  EXPECT_TRUE(three.ledger.matches(three.world.states()));
  three.world.remove(2);
  EXPECT_FALSE(three.ledger.matches(three.world.states())) << "a removed body does not sleep";
  three.ledger.take_out(2);
  EXPECT_TRUE(three.ledger.matches(three.world.states()));
  three.world.move(0, {.position = Vec3(9.0, 1.0, 0.5)});
  EXPECT_FALSE(three.ledger.matches(three.world.states()));
}

RC_GTEST_PROP(SleepLedger, EqualsARecountAfterAnySequence, ()) {
  StillWorld<3> world(cubes());
  SleepLedger<3> ledger(4.0);
  const int actions = *rc::gen::inRange(0, 200);
  for (int i = 0; i < actions; ++i) {
    const int kind = *rc::gen::inRange(0, 5);
    const BodyIndex body = world.states().size() == 0 ? 0 : *rc::gen::inRange(0, world.states().size());
    if (kind == 0 || world.states().size() == 0) {
      world.add({.pose = {.position = Vec3(*rc::gen::inRange(-9, 9), *rc::gen::inRange(-9, 9), 0.5)}});
      continue;
    }
    if (world.states().removed[body] != 0) continue;
    if (kind == 1) {
      world.freeze(std::vector<BodyIndex>{body});
      const auto standing = static_cast<Standing>(*rc::gen::inRange(0, 3));
      ledger.put_in(body, world.states().pose[body].position, standing);
    } else if (kind == 2) {
      world.thaw(std::vector<BodyIndex>{body});
      ledger.take_out(body);
    } else if (kind == 3) {
      world.remove(body);
      ledger.take_out(body);
    } else {
      ledger.settle(ledger.columns().cell_of(world.states().pose[body].position));
    }
    RC_ASSERT(ledger.matches(world.states()));
  }
}

}  // namespace
}  // namespace talus::sleep_ledger_test
