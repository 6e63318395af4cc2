// What the accuracy of a scene sets.

#include "common/scene/accuracy.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/measure/rebuild.h"
#include "common/scene/read_scene.h"
#include "common/scene/reference.h"

namespace talus::accuracy_test {
namespace {

/// Plates, 0.3 m thick, that fall 18 m: they arrive at sqrt(2 g 18) = 18.79 m/s, 62.6 thicknesses a second.
Scene<3> plates(std::vector<Override> overrides) {
  const std::string text =
      "title = \"Plates\"\ndimension = 3\nworld = {gravity = 9.81}\nrun = {frame_rate = 30}\n"
      "shape.plate = {kind = \"box\", size = [1, 1, 0.3]}\n"
      "source = [{count = 3, position = [0, 0, 18], spread = [0, 0, 0]}]\n";
  return std::get<Scene<3>>(parse_scene(text, "text", overrides));
}

Scene<2> discs_at(std::string_view accuracy) {
  const std::string text = fmt::format(
      "title = \"Discs\"\ndimension = 2\naccuracy = \"{}\"\nshape.disc = {{kind = \"ball\", radius = 0.5}}\n"
      "source = [{{count = 3, position = [0, 8]}}]\n",
      accuracy);
  return std::get<Scene<2>>(parse_scene(text, "text"));
}

double steps_of(const std::vector<Override>& overrides) { return 1.0 / plates(overrides).world.dt; }

TEST(Accuracy, ChoosesTheStepByTheWayOfAnArrivingBodyOverItsThickness) {
  EXPECT_NEAR(steps_of({{"accuracy=fast"}}), 60.0, 1e-9);       // 31.3 would do
  EXPECT_NEAR(steps_of({{"accuracy=standard"}}), 120.0, 1e-9);  // 62.6
  EXPECT_NEAR(steps_of({{"accuracy=fine"}}), 180.0, 1e-9);      // 125.3
}

/// Of a hammer with a head 0.4 m thick.
double thickness_of_hammer(double handle) {
  const std::string text = fmt::format(
      "title = \"Hammer\"\ndimension = 2\nshape.head = {{kind = \"box\", size = [0.8, 0.4]}}\n"
      "shape.handle = {{kind = \"box\", size = [{}, 1.4]}}\n"
      "shape.hammer = {{kind = \"compound\", parts = [{{shape = \"handle\"}}, {{shape = \"head\", position = [0, "
      "1]}}]}}\n"
      "source = [{{shape = \"hammer\", count = 3, position = [0, 18]}}]\n",
      handle);
  const auto scene = std::get<Scene<2>>(parse_scene(text, "text"));
  return arrival(scene.sources[0], scene.world).thickness;
}

TEST(Accuracy, TakesABodyForAsThickAsItsThinnestPartThatIsHalfAsThickAsTheThickest) {
  EXPECT_NEAR(thickness_of_hammer(0.3), 0.3, 1e-9);
  EXPECT_NEAR(thickness_of_hammer(0.2), 0.2, 1e-9);
  EXPECT_NEAR(thickness_of_hammer(0.19), 0.4, 1e-9);
  EXPECT_NEAR(thickness_of_hammer(0.5), 0.4, 1e-9);
}

TEST(Accuracy, OfASceneThatNamesNoneIsTheStandard) { EXPECT_EQ(steps_of({}), steps_of({{"accuracy=standard"}})); }

TEST(Accuracy, ChoosesStepsOfWhichAFrameHasAWholeNumber) {
  EXPECT_NEAR(steps_of({{"run.frame_rate=50"}}), 100.0, 1e-9);
  EXPECT_NEAR(steps_of({{"run.frame_rate=24"}}), 72.0, 1e-9);
  EXPECT_NEAR(steps_of({{"run.frame_rate=240"}}), 240.0, 1e-9);
}

TEST(Accuracy, GrowsTheCostOfAStepEightfoldAtMost) {
  EXPECT_NEAR(steps_of({{"source[0].position=[0, 0, 9000]"}}), 480.0, 1e-9);
}

TEST(Accuracy, LeavesWhatTheSceneSetsItself) {
  const Scene<3> scene = plates({{"accuracy=fast"},
                                 {"world.steps_per_second=90"},
                                 {"world.solver.sub_steps=6"},
                                 {"policy.adaptive.tolerance=0.03"},
                                 {"policy.adaptive.rings=1"}});
  EXPECT_NEAR(1.0 / scene.world.dt, 90.0, 1e-9);
  EXPECT_EQ(scene.world.solver.sub_steps, 6);
  EXPECT_EQ(scene.policy.adaptive.tolerance, 0.03);
  EXPECT_EQ(scene.policy.adaptive.rings, 1);
}

TEST(Accuracy, SetsSubStepsToleranceAndRingsOfItsLevel) {
  for (const Accuracy& level : accuracies) {
    const Scene<3> scene = plates({{fmt::format("accuracy={}", level.name)}});
    EXPECT_EQ(scene.world.solver.sub_steps, level.sub_steps[1]) << level.name;
    EXPECT_EQ(discs_at(level.name).world.solver.sub_steps, level.sub_steps[0]) << level.name;
    EXPECT_EQ(scene.policy.adaptive.tolerance, level.tolerance) << level.name;
    EXPECT_EQ(scene.policy.adaptive.rings, level.rings) << level.name;
  }
}

TEST(Accuracy, GivesRingsAtEachLevelWhereSomethingElseThanABodyMoves) {
  for (const Accuracy& level : accuracies)
    EXPECT_EQ(
        plates({{fmt::format("accuracy={}", level.name)}, {"event=[{time=1, do=\"gravity\", gravity=[0, 0, -1]}]"}})
            .policy.adaptive.rings,
        usual_rings)
        << level.name;
  EXPECT_EQ(plates({{"accuracy=fine"}, {"world.solver.kind=engine"}}).policy.adaptive.rings, 0);
}

TEST(Accuracy, OfTheReferenceIsAQuarterOfTheThicknessWithWholeFrames) {
  const Scene<3> reference = reference_scene(plates({{"run.frame_rate=50"}}));
  EXPECT_LE(arrival(reference.sources[0], reference.world).step(reference.world.dt), 0.25);
  const double steps_a_frame = 1.0 / (50.0 * reference.world.dt);
  EXPECT_NEAR(steps_a_frame, std::round(steps_a_frame), 1e-6);
  EXPECT_EQ(reference.policy.kind, "full");
}

TEST(Accuracy, HasTheNumbersOfItsLevelsInTheTextOfItsKey) {
  const auto& [fast, standard, fine] = accuracies;
  const std::string numbers = fmt::format(
      "most {:g}, {:g} or {:g} times its thickness in a step; `sub_steps` {}, {} or {}, in 3D {}, {} or {}; the "
      "`tolerance` {:g}, {:g} or {:g}; the `rings` of a pour {}, {} or {}.",
      fast.step, standard.step, fine.step, fast.sub_steps[0], standard.sub_steps[0], fine.sub_steps[0],
      fast.sub_steps[1], standard.sub_steps[1], fine.sub_steps[1], fast.tolerance, standard.tolerance, fine.tolerance,
      fast.rings, standard.rings, fine.rings);
  const std::string errors = fmt::format("{:g}, {:g} or {:g}. It sets", fast.error, standard.error, fine.error);
  const auto tables = key_tables();
  const auto root = std::ranges::find(tables, "root", &std::pair<std::string, std::string>::first);
  ASSERT_NE(root, tables.end());
  EXPECT_NE(root->second.find(numbers), std::string::npos) << root->second;
  EXPECT_NE(root->second.find(errors), std::string::npos) << root->second;
}

TEST(Accuracy, OfANumberIsTheFastestLevelWithThatError) {
  const std::vector<std::pair<double, std::string>> levels = {{0.5, "fast"},      {0.2, "fast"},   {0.199, "standard"},
                                                              {0.07, "standard"}, {0.069, "fine"}, {0.03, "fine"}};
  for (const auto& [error, level] : levels)
    EXPECT_EQ(plates({{fmt::format("accuracy={}", error)}}).accuracy, level) << error;
  for (const char* refused : {"0.029", "0", "-1", "nan"})
    EXPECT_THROW(plates({{fmt::format("accuracy={}", refused)}}), SceneErrors) << refused;
}

TEST(Accuracy, HasAnErrorWhereTheSceneSetsNoPartOfItsLevel) {
  EXPECT_EQ(calibrated_error(plates({{"accuracy=fine"}})), 0.03);
  EXPECT_EQ(calibrated_error(plates({{"world.solver.sub_steps=4"}})), std::nullopt);
  EXPECT_EQ(calibrated_error(plates({{"policy.kind=full"}})), std::nullopt) << "calibrated with adaptive";
}

TEST(Accuracy, IsTold) {
  EXPECT_EQ(
      accuracy_text(plates({})),
      "accuracy standard, typical error of a poured heap's shape 7 %: 120 steps a second of 8 sub-steps, bodies arrive "
      "at 18.8 m/s and "
      "go 0.52 times their "
      "thickness in a step, tolerance 0.05 D, 2 rings");
}

}  // namespace
}  // namespace talus::accuracy_test
