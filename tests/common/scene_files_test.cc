#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "common/scene/read_scene.h"

namespace talus {
namespace {

const std::filesystem::path scenes = std::filesystem::path(TALUS_SOURCE_DIR) / "scenes";

template <int Dim>
void expect_example_one(const Scene<Dim>& scene) {
  ASSERT_EQ(scene.sources.size(), 1u);
  EXPECT_EQ(scene.sources[0].count, 400);
  EXPECT_EQ(scene.run.frames, 1818);
  EXPECT_EQ(scene.world.dt, 1.0 / 60.0);
  EXPECT_EQ(scene.steps_per_frame(), 2);
  EXPECT_EQ(scene.steps(), 3636);
  ASSERT_EQ(scene.piles.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.piles[0].alpha, std::numbers::pi / 4.0);
  EXPECT_FALSE(scene.piles[0].at.has_value());
  EXPECT_EQ(scene.policy.kind, "paper");
  EXPECT_EQ(scene.policy.paper.tau, 0.5);
}

TEST(DropInAPile, IsThePapersFirstExample) {
  expect_example_one(std::get<Scene<2>>(read_scene(scenes / "drop_in_a_pile_2d.toml")));
  expect_example_one(std::get<Scene<3>>(read_scene(scenes / "drop_in_a_pile_3d.toml")));
}

}  // namespace
}  // namespace talus
