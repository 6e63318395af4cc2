// The scenes of `talus bench truth`.

#include "tools/bench/truth_cell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/read_scene.h"
#include "tools/bench/truth_run.h"
#include "tools/run/backends.h"

namespace talus::truth_cell_test {
namespace {

/// As if the cell's file stood beside the scenes of talus, where its meshes are.
AnyScene scene_of(const TruthCell& cell) {
  return parse_scene(cell.text, std::string(TALUS_SOURCE_DIR) + "/scenes/" + cell.name + ".toml");
}

TEST(TruthCells, EveryCellOfTheDesignPoursAllItsBodies) {
  for (const TruthCell& cell : truth_design(1, 60, {16, 10})) {
    if (backends(cell.dimension).empty()) continue;  // a build without Bullet
    std::visit(
        [&]<int Dim>(const Scene<Dim>& scene) {
          EXPECT_EQ(Dim, cell.dimension);
          const TruthRun<Dim> run = truth_run(scene, backends(Dim).front(), cell.geometry, {false, 0});
          EXPECT_EQ(run.values["bodies"], scene.sources.front().count) << cell.name;
        },
        scene_of(cell));
  }
}

TEST(TruthCells, ACellIsFoundByItsName) {
  for (const TruthCell& cell : truth_design(2, 20, {})) {
    const auto found = truth_cell_named(cell.name, {});
    ASSERT_TRUE(found) << cell.name;
    EXPECT_EQ(found->text, cell.text);
  }
  EXPECT_FALSE(truth_cell_named("2d-f0.2-L-r6.6-slope", {}));
  EXPECT_FALSE(truth_cell_named("2d-f0.2-L-r6.6-slope-g9.81-more", {}));
  EXPECT_FALSE(truth_cell_named("2d-f0.3-L-r6.6-slope-g9.81", {}));
}

TEST(TruthCells, ASlopeIsInclinedBySevenTenthsOfTheFrictionAngle) {
  const auto cell = truth_cell_named("3d-f1-box-r6.6-slope-g9.81", {});
  ASSERT_TRUE(cell);
  EXPECT_NEAR(cell->geometry.slope * 180.0 / 3.14159265, 0.7 * 45.0, 1e-6);
  EXPECT_TRUE(cell->geometry.has_spill()) << "bodies may roll off its end";
  EXPECT_FALSE(truth_cell_named("3d-f1-box-r6.6-flat-g9.81", {})->geometry.has_spill());
}

/// One plate, which friction holds flat on the slope.
template <int Dim>
double height_over_slope(const std::string& name) {
  auto cell = truth_cell_named(name, {1, 1});
  const auto run = truth_run(std::get<Scene<Dim>>(scene_of(*cell)), backends(Dim).front(), cell->geometry, {false, 0});
  return run.values["centre"];
}

TEST(TruthCells, HeightsOnASlopeCountFromItsFace) {
  EXPECT_NEAR(height_over_slope<2>("2d-f0.35-plate-r6.6-slope-g9.81"), 0.1, 0.03);
  if (backends(3).empty()) return;  // a build without Bullet
  EXPECT_NEAR(height_over_slope<3>("3d-f0.35-plate-r6.6-slope-g9.81"), 0.1, 0.05);
}

TEST(TruthCells, ABinSpillsSomeOfItsBodiesAndAHopperLetsSomeThrough) {
  for (const char* name : {"2d-f0.35-box-r6.6-bin-g9.81", "2d-f0.35-box-r6.6-hopper-g9.81"}) {
    const auto cell = truth_cell_named(name, {});
    ASSERT_TRUE(cell->geometry.has_spill());
    const auto run = truth_run(std::get<Scene<2>>(scene_of(*cell)), backends(2).front(), cell->geometry, {false, 0});
    EXPECT_GT(run.values["spill"], 0.0) << name;
    EXPECT_LT(run.values["spill"], 150.0) << name;
  }
}

TEST(TruthRun, UnderAdaptiveFewerBodiesAreAwakeThanAreThere) {
  const auto cell = truth_cell_named("2d-f0.6-L-r6.6-flat-g9.81", {30, 10});
  const auto run = truth_run(std::get<Scene<2>>(scene_of(*cell)), backends(2).front(), cell->geometry, {true, 4});
  EXPECT_EQ(run.values["bodies"], 30.0);
  EXPECT_EQ(run.values["all_asleep"], 1.0);
  EXPECT_GT(run.values["awake_sampled"], 0.0);
  EXPECT_GT(run.values["moving_sampled"], 0.0);
  EXPECT_LT(run.values["mean_awake"], 20.0);
  EXPECT_LT(run.values["drift_mean_D"], 0.5);
  EXPECT_GT(run.values["r95"], run.values["r50"]);
}

TEST(TruthRun, RunsToTenSecondsAfterThePour) {
  const auto cell = truth_cell_named("2d-f0.6-L-at_once-flat-g9.81", {20, 10});
  const auto run = truth_run(std::get<Scene<2>>(scene_of(*cell)), backends(2).front(), cell->geometry, {false, 0});
  EXPECT_EQ(run.values["steps"], 601.0) << "one step for the pour";
}

/// The gate lies on the ground, so that a body would be pushed out of it if it were back in the wake test.
TEST(TruthRun, AnObstacleThatWasRemovedIsNotThereOnceAllAreWoken) {
  constexpr const char* text = R"(
title = "A box on a gate that vanishes"
dimension = 2
shape.box = {kind = "box", size = [1, 1]}
run.frames = 150
[[body]]
position = [0, 1.0]
[[obstacle]]
name = "gate"
kind = "box"
size = [4, 0.5]
position = [0, 0.25]
[[event]]
time = 2
do = "remove"
obstacle = "gate"
)";
  const auto scene = std::get<Scene<2>>(parse_scene(text, "gate.toml"));
  const TruthRun<2> run = truth_run(scene, backends(2).front(), {}, {true, 8, true});
  EXPECT_NEAR(run.values["centre"], 0.5, 0.02);
  EXPECT_LT(run.values["drift_mean_D"], 0.005);
  EXPECT_TRUE(std::isnan(run.values["moving_sampled"])) << "forks have the obstacles of the start";
}

TEST(TruthRun, DriftIsNotMeasuredWhileAnObstacleMoves) {
  constexpr const char* text = R"(
title = "A box on a plate that turns"
dimension = 2
shape.box = {kind = "box", size = [1, 1]}
run.frames = 30
[[body]]
position = [0, 1.0]
[[obstacle]]
kind = "box"
size = [4, 0.5]
position = [0, 0.25]
motion = {kind = "turn", speed_deg = 1}
)";
  const auto scene = std::get<Scene<2>>(parse_scene(text, "plate.toml"));
  const TruthRun<2> run = truth_run(scene, backends(2).front(), {}, {true, 0, true});
  EXPECT_TRUE(std::isnan(run.values["drift_mean_D"]));
}

}  // namespace
}  // namespace talus::truth_cell_test
