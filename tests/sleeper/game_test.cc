#include "tests/sleeper/game.h"

#include <gtest/gtest.h>

#include "tests/sleeper/box2d_scene.h"
#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

template <typename Scene>
void expect_sound(Game<Scene>& game) {
  game.rest();
  EXPECT_EQ(game.lost(), "");
  EXPECT_TRUE(game.refuses_removed());
  EXPECT_LE(game.awake(), 3) << game.boxes() << " boxes";
  EXPECT_LE(game.highest_slot(), game.most_boxes);  // the most there ever were at once, and the lift
  EXPECT_EQ(game.floating(), 0);
}

template <typename Scene>
void play(unsigned seed, int turns) {
  Game<Scene> game(seed);
  game.play(turns);
  expect_sound(game);
}

class AGame : public ::testing::TestWithParam<unsigned> {};

TEST_P(AGame, OnBulletLeavesNoBodyFloatingHangingOrLost) { play<SleepingBulletScene>(GetParam(), 400); }
TEST_P(AGame, OnBox2dLeavesNoBodyFloatingHangingOrLost) { play<SleepingBox2dScene>(GetParam(), 400); }

INSTANTIATE_TEST_SUITE_P(Seeds, AGame, ::testing::Range(1U, 9U));

class LongGame : public ::testing::TestWithParam<unsigned> {};

TEST_P(LongGame, OnBulletLeavesNoBodyFloatingHangingOrLost) { play<SleepingBulletScene>(GetParam(), 5000); }
TEST_P(LongGame, OnBox2dLeavesNoBodyFloatingHangingOrLost) { play<SleepingBox2dScene>(GetParam(), 5000); }

INSTANTIATE_TEST_SUITE_P(Seeds, LongGame, ::testing::Range(101U, 109U));

}  // namespace
}  // namespace talus::test
