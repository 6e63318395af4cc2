// What keeps the picture of very many bodies small.

#include <gtest/gtest.h>

#include <numeric>

#include "tests/common/temporary_folder.h"
#include "tests/picture/sample.h"
#include "tools/picture/face.h"
#include "tools/picture/layers.h"

namespace talus::many_bodies_test {
namespace {

TEST(CoarseLayers, HoldTheSameBodiesInFewerSlicesOfTheSamePile) {
  Sample<3> sample;
  sample.add_pile(100000.0);
  Pile<3>& pile = sample.piles[0];
  ASSERT_GT(pile.layers.size(), 20U);
  for (std::size_t i = 0; i < pile.layers.size(); ++i) pile.layers[i].count = static_cast<int>(i) + 1;
  const Pile<3> coarse = with_coarse_layers(pile, 7);
  EXPECT_LE(coarse.layers.size(), 7U);
  EXPECT_EQ(coarse.layers.front().bottom, pile.layers.front().bottom);
  EXPECT_EQ(coarse.layers.back().top, pile.layers.back().top);
  EXPECT_DOUBLE_EQ(coarse.occupation_ratio(), pile.occupation_ratio());
  for (std::size_t i = 1; i < coarse.layers.size(); ++i) {
    EXPECT_EQ(coarse.layers[i].bottom, coarse.layers[i - 1].top);
    EXPECT_LT(coarse.layers[i].radius, coarse.layers[i - 1].radius);
  }
}

TEST(CoarseLayers, LeaveAPileOfFewAlone) {
  Sample<2> sample;
  sample.add_pile(50.0);
  EXPECT_EQ(with_coarse_layers(sample.piles[0], 32).layers.size(), sample.piles[0].layers.size());
}

// A block of 64 x 64 x 32 bodies, just over an extent apart: seen are its top, its sides, and one more layer beneath
// these.
TEST(ExposedBodies, AreTheSkinOfAThickBlock) {
  Sample<3> sample;
  constexpr int side = 64;
  constexpr int tall = 32;
  const double spacing = 1.001 * sample.shapes[0].extent;
  for (int i = 0; i < side * side * tall; ++i)
    sample.add(spacing * Vec3(i % side, i / side % side, i / side / side), true);
  std::vector<BodyIndex> all(sample.states.shape.size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<BodyIndex> seen = exposed(sample.input(), all);
  std::vector<int> layers(tall, 0);
  for (const BodyIndex body : seen) ++layers[body / (side * side)];
  EXPECT_EQ(layers[tall - 1], side * side);
  EXPECT_EQ(layers[tall / 2], side * side - (side - 2) * (side - 2)) << "only the four sides";
  EXPECT_EQ(layers[0], side * side - (side - 2) * (side - 2));
}

TEST(Picture, ShowsTensOfThousandsIn2DAsAnImageWithinTheSvg) {
  const TemporaryFolder folder;
  Sample<2> sample;
  sample.add_rows(5001);
  draw_pile<2>(folder / "a.svg", folder / "a.png", sample.input(), {.width = 300, .height = 300});
  EXPECT_LT(bytes_of(folder / "a.svg").size(), 1000000U);  // as vectors ten times as much
  EXPECT_NE(bytes_of(folder / "a.svg").find("<image"), std::string::npos);
}

}  // namespace
}  // namespace talus::many_bodies_test
