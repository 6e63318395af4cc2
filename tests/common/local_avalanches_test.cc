// Where the policy `adaptive` lets heaps of sleeping bodies slide.

#include "common/policy/wake_rules/local_avalanches.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/common/adaptive_rules.h"

namespace talus::local_avalanches_test {
namespace {

/// Cubes of 1 m that sleep where they are put, and the rule with D = 1 m: columns 4 m wide, which may slide down more
/// than 4 m tan(25 degrees) = 1.9 m to the next.
class LocalAvalanchesTest : public testing::Test {
 protected:
  LocalAvalanchesTest() : world_(cubes()), avalanches_(RuleParts{.extent = 1.0}.setup()) {}

  /// Puts so many cubes to sleep in layers of four by four, upwards from the ground, in the column whose corner is at
  /// (x, 0).
  std::vector<BodyIndex> lay(int cubes, double x) {
    std::vector<BodyIndex> bodies;
    for (int i = 0; i < cubes; ++i) {
      const Vec3 place(x + 0.5 + i % 4, 0.5 + i / 4 % 4, 0.5 + i / 16);
      bodies.push_back(world_.add({.pose = {.position = place}}));
    }
    put_to_sleep(bodies);
    return bodies;
  }

  void put_to_sleep(const std::vector<BodyIndex>& bodies) {
    world_.freeze(bodies);
    for (const BodyIndex body : bodies) {
      const Vec3& position = world_.states().pose[body].position;
      sleepers_.put_in(body, position, Standing::fresh);
      avalanches_.note_asleep(position);
    }
  }

  void wake(const std::vector<BodyIndex>& bodies) {
    world_.thaw(bodies);
    for (const BodyIndex body : bodies) sleepers_.take_out(body);
  }

  /// The bodies that the rule wakes.
  std::vector<BodyIndex> sliding() {
    RuleOutput<3> out;
    avalanches_.update(input(world_, 0, piles_), sleepers_, out);
    return bodies_in(out.wakes);
  }

  StillWorld<3> world_;
  LocalAvalanches<3> avalanches_;
  SleepLedger<3> sleepers_{4.0};
  std::vector<Pile<3>> piles_;
};

TEST_F(LocalAvalanchesTest, ASteepHeapWakesWithWhatLiesAroundItAndNoFarther) {
  std::vector<BodyIndex> heap = lay(48, 0.0);
  const std::vector<BodyIndex> beside = lay(5, 4.0);
  lay(5, 8.0);  // another column between them
  heap.insert(heap.end(), beside.begin(), beside.end());
  EXPECT_EQ(sliding(), heap);
}

TEST_F(LocalAvalanchesTest, FewBodiesAreNoHeap) {
  lay(10, 0.0);
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, AHeapNoSteeperThanTheAngleStays) {
  lay(32, 0.0);  // highest centres at 1.5 m, the next column's at the ground
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, AHeapAmongMoreAwakeBodiesIsLeftToTheirImpacts) {
  lay(48, 0.0);
  for (int i = 0; i < 49; ++i) world_.add({.pose = {.position = Vec3(5.0 + 0.05 * i, 1.0, 0.5)}});
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, APlainStaysHoweverHigh) {
  // Walls along both sides: nothing can slide off the plain's edges.
  Pile<3> pile;
  pile.centre = Vec3(2.0, 2.0, 0.0);
  pile.boundary = box_boundary<3>(Eigen::Vector2d(20.0, 4.0), 20.0);
  piles_.push_back(pile);
  for (const double x : {-8.0, -4.0, 0.0, 4.0, 8.0}) lay(160, x);
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, AHeapThatWasCheckedIsNotCheckedUntilItHasGrown) {
  const std::vector<BodyIndex> heap = lay(48, 0.0);
  EXPECT_EQ(sliding().size(), heap.size());
  wake(heap);
  EXPECT_TRUE(sliding().empty());
  put_to_sleep(heap);
  EXPECT_TRUE(sliding().empty());
  lay(7, 0.0);  // 55 < 1.15 * 48
  EXPECT_TRUE(sliding().empty());
  lay(1, 0.0);
  EXPECT_EQ(sliding().size(), heap.size() + 8);
}

TEST_F(LocalAvalanchesTest, AColumnThatWokeBesideAHeapCountsAsChecked) {
  lay(100, 4.0);
  EXPECT_EQ(sliding().size(), 100);
  lay(14, 4.0);
  EXPECT_TRUE(sliding().empty());
  lay(48, 0.0);
  EXPECT_EQ(sliding().size(), 162);
  lay(6, 4.0);  // 120 > 1.15 * 100, but < 1.15 * 114
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, AHeapThatSleepsAgainUnchangedIsNotCheckedAgain) {
  const std::vector<BodyIndex> heap = lay(48, 0.0);
  EXPECT_EQ(sliding().size(), heap.size());
  wake(heap);
  put_to_sleep(heap);
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, NothingSlidesThroughAWall) {
  lay(48, 0.0);
  Pile<3> pile;
  pile.centre = Vec3(2.0, 2.0, 0.0);
  pile.boundary = box_boundary<3>(Eigen::Vector2d(4.0, 4.0), 10.0);
  piles_.push_back(pile);
  EXPECT_TRUE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, OnlyBodiesAboveTheRimSlideOverAWall) {
  Pile<3> pile;
  pile.centre = Vec3(2.0, 2.0, 0.0);
  pile.boundary = box_boundary<3>(Eigen::Vector2d(4.0, 4.0), 1.0);
  piles_.push_back(pile);
  lay(48, 0.0);  // highest centres at 2.5 m, 1.5 m above the rim
  EXPECT_TRUE(sliding().empty());
  lay(5, 4.0);  // spilt, and lower than the rim
  EXPECT_TRUE(sliding().empty());
  lay(16, 0.0);  // on the heap's foot, so that it is checked again
  EXPECT_TRUE(sliding().empty());
  lay(80, 0.0);  // up to 4.5 m
  EXPECT_FALSE(sliding().empty());
}

TEST_F(LocalAvalanchesTest, ARemovedBodyNoLongerCounts) {
  const std::vector<BodyIndex> heap = lay(48, 0.0);
  world_.remove(heap.back());
  sleepers_.take_out(heap.back());
  EXPECT_EQ(sliding().size(), heap.size() - 1);
}

}  // namespace
}  // namespace talus::local_avalanches_test
