#include <gtest/gtest.h>

#include "common/scene/setting_differences.h"

namespace talus::scene_setting_differences_test {
namespace {

TEST(SettingDifferences, NamesEachSettingWithBothValues) {
  const auto differences = setting_differences(R"(
title = "a"
[world]
gravity = 9.81
[[source]]
count = 400
position = [0.0, 5.0]
)",
                                               R"(
title = "a"
[world]
gravity = 9.81
dt = 0.01
[[source]]
count = 200
position = [0.0, 6.0]
)");
  const std::vector<SettingDifference> expected = {
      {"source[0].count", "400", "200"}, {"source[0].position", "[0.0, 5.0]", "[0.0, 6.0]"}, {"world.dt", "", "0.01"}};
  EXPECT_EQ(differences, expected);
}

TEST(SettingDifferences, TakesAWholeNumberForTheSameWithOrWithoutAPoint) {
  EXPECT_TRUE(setting_differences("x = 30", "x = 30.0").empty());
  EXPECT_TRUE(setting_differences("x = [0, 8]", "x = [0.0, 8.0]").empty());
  EXPECT_TRUE(setting_differences("x = 0x1E", "x = 30").empty());
  EXPECT_EQ(setting_differences("x = 30", "x = 31.0").size(), 1U);
  EXPECT_EQ(setting_differences("x = [0, 8]", "x = [0, 8, 1]").size(), 1U);
}

TEST(SettingDifferences, TakeADefaultThatIsWrittenOutForNone) {
  const std::string scene =
      "title = \"A disc\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\nbody = [{position = [0, 9]}]\n";
  EXPECT_TRUE(setting_differences(scene, scene + "seed = 1\naccuracy = \"standard\"\n").empty());
  EXPECT_EQ(setting_differences(scene, scene + "seed = 2\n").size(), 1U);
}

TEST(SettingDifferences, CountPolicyTitleAndLengthAsTheSameScene) {
  for (const char* path :
       {"title", "run.frames", "run.threads", "run.pace", "run.contacts", "policy.kind", "policy.tau"})
    EXPECT_FALSE(is_of_scene({path, "1", "2"})) << path;
  for (const char* path : {"seed", "source[0].count", "world.gravity", "run.frame_rate"})
    EXPECT_TRUE(is_of_scene({path, "1", "2"})) << path;
}

}  // namespace
}  // namespace talus::scene_setting_differences_test
