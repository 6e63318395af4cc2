// The window in which an engine's results hold: each rule refuses just outside and accepts just inside.

#include <gtest/gtest.h>

#include "common/scene/read_scene.h"
#include "common/scene/window.h"

namespace talus::scene_window_test {
namespace {

constexpr EngineTraits narrow_engine = {
    .name = "narrow",
    .window = {.fewest_steps = 50.0, .fewest_iterations = 5, .largest_mass_ratio = 20.0, .longest_obstacle = 100.0}};

// What of a sound scene with these changes lies outside, a line each.
std::string outside_with(const std::vector<Override>& overrides, const EngineTraits& engine = narrow_engine) {
  const std::string text =
      "title = \"A scene\"\ndimension = 3\nshape.ball = {kind = \"ball\", radius = 0.5}\n"
      "source = [{rate = 2, count = 10}]\npile = [{alpha_deg = 20}]\n"
      "obstacle = [{kind = \"box\", size = [10, 1, 0.1], position = [0, 0, 20]}]\n";
  std::string lines;
  for (const SceneError& each :
       outside_window(std::get<Scene<3>>(parse_scene(text, "scene.toml", overrides)), engine, "scene.toml"))
    lines += to_string(each) + "\n";
  return lines;
}

void expect_one(const std::string& lines, const std::string& start) {
  EXPECT_TRUE(lines.starts_with(start)) << lines;
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1) << lines;
}

TEST(SceneWindow, HoldsASoundScene) { EXPECT_EQ(outside_with({}), ""); }

TEST(SceneWindow, EndsAtLongSteps) {
  const Override frames{"run.frame_rate=5"};
  expect_one(outside_with({{"world.steps_per_second=45"}, frames}),
             "scene.toml: world.steps_per_second = 45: must be at least 50 on narrow: in longer steps");
  EXPECT_EQ(outside_with({{"world.steps_per_second=50"}, frames}), "");
}

TEST(SceneWindow, EndsAtFewIterations) {
  const Override solver{"world.solver.kind=\"engine\""};
  expect_one(outside_with({solver, {"world.solver.velocity_iterations=4"}}),
             "scene.toml: world.solver.velocity_iterations = 4: must be at least 5 on narrow");
  EXPECT_EQ(outside_with({solver, {"world.solver.velocity_iterations=5"}}), "");
}

TEST(SceneWindow, EndsAtMassesTooDifferentForTheIterations) {
  const auto heavy = [](int density) {
    return Override{"shape.heavy={kind=\"ball\", radius=0.5, density=" + std::to_string(density) + "}"};
  };
  const Override solver{"world.solver.kind=\"engine\""};
  expect_one(outside_with({solver, heavy(21'000)}),
             "scene.toml: world.solver.velocity_iterations = 10 with shape.heavy of 21 times the mass of shape.ball: "
             "must be at least 50 on narrow where masses of bodies differ by a factor of more than 20");
  EXPECT_EQ(outside_with({solver, heavy(20'000)}), "");
  EXPECT_EQ(outside_with({solver, heavy(21'000), {"world.solver.velocity_iterations=50"}}), "");
  EXPECT_EQ(outside_with({solver, heavy(21'000), {"source[0].shape=\"ball\""}}), "");
}

TEST(SceneWindow, EndsAtObstaclesThatAreLongBesideTheirThickness) {
  const Override longer{"obstacle[0].size=[10.5,1,0.1]"};
  EXPECT_NE(outside_with({longer}).find("10.5 m long and 0.1 m thick: must be at most 100 times"), std::string::npos)
      << outside_with({longer});
  EXPECT_EQ(outside_with({{"obstacle[0].size=[10.5,1,0.106]"}}), "");
}

TEST(SceneWindow, EndsAtATauOfZeroUnderPaperOnly) {
  const Override zero{"policy.tau=0"};
  const Override paper{"policy.kind=paper"};
  expect_one(outside_with({paper, zero}), "scene.toml: policy.tau = 0: must be above 0 under the policy paper");
  EXPECT_EQ(outside_with({paper, {"policy.tau=0.01"}}), "");
  EXPECT_EQ(outside_with({zero}), "");
}

TEST(SceneWindow, OfAnotherEngineHasTheSameTextButForNameAndNumber) {
  const EngineTraits wide = {.name = "wide", .window = {.fewest_steps = 60.0}};
  const std::vector<Override> steps = {{"world.steps_per_second=45"}, {"run.frame_rate=5"}};
  std::string expected = outside_with(steps);
  expected.replace(expected.find("50 on narrow"), 12, "60 on wide");
  EXPECT_EQ(outside_with(steps, wide), expected);
}

TEST(SceneWindow, ListsARuleForEachLimitThatAnEngineHas) {
  EXPECT_EQ(window_rules(narrow_engine).size(), 5U);
  EXPECT_EQ(window_rules({.name = "wide"}).size(), 2U);
}

TEST(SceneWindow, IsRefusedWithTheWayOut) {
  EXPECT_NO_THROW(refuse_outside_window({}));
  const std::vector<SceneError> outside = {{"scene.toml", 0, 0, "policy.tau", "0", "must be above 0", {}}};
  try {
    refuse_outside_window(outside);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("policy.tau = 0: must be above 0"), std::string::npos);
  }
}

}  // namespace
}  // namespace talus::scene_window_test
