#include <gtest/gtest.h>

#include "common/scene/read_scene.h"
#include "common/scene/setting_differences.h"

namespace talus::scene_setting_differences_test {
namespace {

TEST(SettingDifferences, NamesEachSettingWithBothValues) {
  const auto differences = setting_differences({R"(
title = "a"
[world]
gravity = 9.81
[[source]]
count = 400
position = [0.0, 5.0]
)",
                                                ""},
                                               {R"(
title = "a"
[world]
gravity = 9.81
dt = 0.01
[[source]]
count = 200
position = [0.0, 6.0]
)",
                                                ""});
  const std::vector<SettingDifference> expected = {
      {"source[0].count", "400", "200"}, {"source[0].position", "[0.0, 5.0]", "[0.0, 6.0]"}, {"world.dt", "", "0.01"}};
  EXPECT_EQ(differences, expected);
}

TEST(SettingDifferences, TakesAWholeNumberForTheSameWithOrWithoutAPoint) {
  const auto differ = [](const char* a, const char* b) { return !setting_differences({a, ""}, {b, ""}).empty(); };
  EXPECT_FALSE(differ("x = 30", "x = 30.0"));
  EXPECT_FALSE(differ("x = [0, 8]", "x = [0.0, 8.0]"));
  EXPECT_FALSE(differ("x = 0x1E", "x = 30"));
  EXPECT_TRUE(differ("x = 30", "x = 31.0"));
  EXPECT_TRUE(differ("x = [0, 8]", "x = [0, 8, 1]"));
}

TEST(SettingDifferences, TakeADefaultThatIsWrittenOutForNoneAndNameItWhereTheOtherDiffers) {
  const auto texts = [](const std::string& more) {
    const std::string scene =
        "title = \"A disc\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
        "body = [{position = [0, 9]}]\n" +
        more;
    return SceneTexts{scene, with_every_default(scene, "scene.toml")};
  };
  EXPECT_TRUE(setting_differences(texts(""), texts("seed = 1\naccuracy = \"standard\"\n")).empty());
  const std::vector<SettingDifference> seeds = {{"seed", "2", "1"}};
  EXPECT_EQ(setting_differences(texts("seed = 2\n"), texts("")), seeds);
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
