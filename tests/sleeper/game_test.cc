#include "tests/sleeper/game.h"

#include <gtest/gtest.h>

#include "tests/sleeper/box2d_scene.h"
#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

template <typename Scene>
void play(unsigned seed, int operations) {
  Game<Scene> game(seed);
  ASSERT_EQ(game.play(operations), "");
  expect_sound(game);
}

class AGame : public ::testing::TestWithParam<unsigned> {};

TEST_P(AGame, OnBulletLeavesNoBodyFloatingHangingOrLost) { play<SleepingBulletScene>(GetParam(), 400); }
TEST_P(AGame, OnBox2dLeavesNoBodyFloatingHangingOrLost) { play<SleepingBox2dScene>(GetParam(), 400); }

INSTANTIATE_TEST_SUITE_P(Seeds, AGame, ::testing::Range(1U, 9U));

class LongGame : public ::testing::TestWithParam<unsigned> {};

TEST_P(LongGame, OnBulletLeavesNoBodyFloatingHangingOrLost) { play<SleepingBulletScene>(GetParam(), 10000); }
TEST_P(LongGame, OnBox2dLeavesNoBodyFloatingHangingOrLost) { play<SleepingBox2dScene>(GetParam(), 10000); }

INSTANTIATE_TEST_SUITE_P(Seeds, LongGame, ::testing::Range(101U, 103U));

}  // namespace
}  // namespace talus::test
