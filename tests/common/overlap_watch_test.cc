// Which overlaps count: those that last, of bodies awake or just fallen asleep.

#include "common/simulation/overlap_watch.h"

#include <gtest/gtest.h>

#include "common/shape/catalogue.h"
#include "tests/common/still_world.h"

namespace talus::overlap_watch_test {
namespace {

Scene<2> scene_of_discs() {
  Scene<2> scene;
  scene.world.gravity = 9.81;
  scene.world.shapes = {make_shape<2>("disc", ball_pieces<2>(0.5), {})};
  return scene;
}

class Overlaps : public ::testing::Test {
 protected:
  Overlaps() {
    world.record_contacts(true);
    for (int i = 0; i < 4; ++i) world.add({});
  }
  /// A sample with these depths [D] of the pairs (a, b).
  std::vector<OverlapWatch<2>::Finding> sample(const std::vector<std::tuple<BodyIndex, BodyIndex, double>>& pairs) {
    world.touching.clear();
    for (const auto& [a, b, depth] : pairs) world.touching.push_back({.a = a, .b = b, .depth = depth * extent});
    world.step();
    const auto found = watch.sample(world, 0);
    return {found.begin(), found.end()};
  }

  /// The numbers of those of the next steps that are sampled.
  std::vector<std::int64_t> sampled_steps(int steps) {
    std::vector<std::int64_t> sampled;
    for (const std::int64_t end = step_ + steps; step_ < end;) {
      world.step();
      if (!watch.due(++step_)) continue;
      watch.sample(world, step_);
      sampled.push_back(step_);
    }
    return sampled;
  }

  Scene<2> scene = scene_of_discs();
  double extent = scene.world.shapes[0].extent;
  StillWorld<2> world{scene.world};
  OverlapWatch<2> watch{extent, scene.world.gravity, scene.world.dt};

 private:
  std::int64_t step_ = 0;
};

TEST_F(Overlaps, OfAnImpactDoNotCount) {
  EXPECT_TRUE(sample({{0, ground_index, 0.4}}).empty());
  EXPECT_TRUE(sample({{0, ground_index, 0.01}}).empty());
  EXPECT_TRUE(sample({{0, ground_index, 0.4}}).empty());
  EXPECT_EQ(watch.overlap().share, 0.0);
}

TEST_F(Overlaps, ThatLastCountByTheirLesserDepth) {
  sample({{0, 1, 0.3}});
  const auto found = sample({{0, 1, 0.25}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].body, 0);
  EXPECT_EQ(found[1].body, 1);
  EXPECT_NEAR(found[0].depth, 0.25, 1e-12);
  EXPECT_NEAR(watch.overlap().deepest, 0.25, 1e-12);
}

TEST_F(Overlaps, OfTwoPairsAreNotTakenForOneThatLasts) {
  sample({{0, 1, 0.3}});
  EXPECT_TRUE(sample({{0, 2, 0.3}}).empty());
}

TEST_F(Overlaps, OfOrdinaryContactsAreMeasuredWithoutAWarning) {
  sample({{0, 1, 0.03}});
  EXPECT_TRUE(sample({{0, 1, 0.02}}).empty());
  EXPECT_NEAR(watch.overlap().deepest, 0.02, 1e-12);
}

TEST_F(Overlaps, CountThePointThatIsDeepest) {
  sample({{0, 1, 0.0}, {0, 1, 0.3}, {0, 2, 0.0}});
  EXPECT_EQ(sample({{0, 1, 0.2}, {0, 1, 0.3}}).size(), 2U);
  EXPECT_NEAR(watch.overlap().share, 1.0 / 3.0, 1e-12) << "one that lasted, of three pairs in two samples";
}

// Contacts of sleepers are in no list, so what they were pressed into shows only when they fall asleep.
TEST_F(Overlaps, OfBodiesThatFallAsleepSoCount) {
  sample({{0, ground_index, 0.3}, {1, 2, 0.3}, {3, ground_index, 0.3}});
  world.freeze(std::vector<BodyIndex>{0, 1});
  const auto found = sample({{2, ground_index, 0.0}});
  ASSERT_EQ(found.size(), 1U) << "2 is awake and parted from 1, 3 is awake and left the ground";
  EXPECT_EQ(found[0].body, 0);
  EXPECT_TRUE(sample({}).empty()) << "once";
}

TEST_F(Overlaps, OfAPairAreTheSameWhicheverOfThemIsAwake) {
  sample({{0, 1, 0.3}});
  world.freeze(std::vector<BodyIndex>{0});
  EXPECT_EQ(sample({{1, 0, 0.3}}).size(), 2U);
}

TEST_F(Overlaps, AreSampledOftenEnoughForGravityAndSeldomEnoughForTheCost) {
  // sqrt(D/g) is 0.38 s, 23 steps.
  EXPECT_EQ(sampled_steps(92), (std::vector<std::int64_t>{23, 46, 69, 92}));
  world.set_gravity(Vec2(0.0, -1000.0));
  EXPECT_EQ(sampled_steps(60), (std::vector<std::int64_t>{115, 131, 147})) << "from the next sample on";
}

}  // namespace
}  // namespace talus::overlap_watch_test
