#include <gtest/gtest.h>

#include <cmath>

#include "common/measure/work.h"
#include "common/shape/catalogue.h"
#include "tests/common/falling_world.h"
#include "tests/common/made_up_run.h"

namespace talus::measure_work_test {
namespace {

const std::vector<double> two_metres = {2.0};

TEST(Work, CountsBodiesNotSimulated) {
  WorldDescription<2> description;
  description.shapes = {make_shape<2>("cube", box_pieces<2>(Vec2::Ones()), {})};
  FallingWorld<2> world(description);
  const PileSet<2> piles(std::vector<PileParams<2>>{}, TypicalBody{});
  for (int i = 0; i < 4; ++i) world.add({0, {Vec2(i, 5.0)}, Vec2::Zero(), Spin<2>::Zero()});
  WorkCounter<2> counter(true);
  counter.on_frame({1, 0.01, world, piles, {}, {}});
  EXPECT_EQ(counter.work().skipped(), 0.0);
  world.freeze(std::vector<BodyIndex>{0, 2, 3});
  world.remove(3);
  counter.on_frame({2, 0.02, world, piles, {}, {}});
  EXPECT_EQ(counter.work().body_steps, 4 + 3);
  EXPECT_EQ(counter.work().simulated, 4 + 1);
  EXPECT_DOUBLE_EQ(counter.work().skipped(), 2.0 / 7);
}

TEST(Work, ComparesContactsWithAFullRuns) {
  EXPECT_DOUBLE_EQ(contacts_skipped({.contacts = 25}, {.contacts = 100}), 0.75);
  EXPECT_EQ(contacts_skipped({}, {}), 0.0);
}

/// Body 0 stands, body 1 walks 0.1 m a frame for 20 of 40 frames, then stands.
Trajectory<2> walk() {
  return made_up_run<2>(40, 0.1, [](int frame) { return std::vector<Vec2>{{0, 0}, {0.1 * std::min(frame, 20), 5}}; });
}

TEST(Hindsight, CountsBodyFramesThatMove) {
  // Within 0.5 s = 5 frames the walker moves more than 0.15 D = 0.3 m (4 steps of 0.1 m) as long as 4 steps are left:
  // from frame 0 to 16. Frames 0 to 34 have their window within the run: 17 of 70 body-frames.
  const Hindsight moving = hindsight<2>(walk(), two_metres, 0.15);
  EXPECT_DOUBLE_EQ(moving.share, 17.0 / 70);
  EXPECT_DOUBLE_EQ(moving.ratio, 70.0 / 17);
}

TEST(Hindsight, HasRatiosOfItsOwnForThePourAndAfterIt) {
  EXPECT_DOUBLE_EQ(hindsight<2>(walk(), two_metres, 0.15, 0.5, 0, 10).ratio, 2.0);
  EXPECT_TRUE(std::isinf(hindsight<2>(walk(), two_metres, 0.15, 0.5, 20).ratio));
}

TEST(Hindsight, CountsABodyThatLeavesAndReturns) {
  const auto there_and_back = made_up_run<2>(7, 0.1, [](int frame) {
    return std::vector<Vec2>{{frame == 2 ? 1.0 : 0.0, 0}};
  });
  EXPECT_DOUBLE_EQ(hindsight<2>(there_and_back, two_metres, 0.2).share, 1.0);
  EXPECT_THROW(hindsight<2>(there_and_back, two_metres, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace talus::measure_work_test
