// `talus run --measure-drift` and what it leaves.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/process/process.h"

namespace talus::measure_drift_test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Engine {
  const char* name;
  int dimension;
};

std::vector<Engine> engines() {
  std::vector<Engine> all = {{"box2d", 2}};
#ifdef TALUS_BULLET
  all.push_back({"bullet-planar", 2});
  all.push_back({"bullet", 3});
#endif
  return all;
}

/// Cubes of 1 m whose undersides are at these heights [D], 5 m apart; four steps. `rest`: further tables of the scene.
void write_cubes(const std::string& file, int dimension, const std::vector<double>& heights, const std::string& body,
                 const std::string& rest = "") {
  std::ofstream out(file);
  out << "title = \"cubes\"\ndimension = " << dimension << "\nrun = {frames = 4, frame_rate = 60}\n"
      << rest << "[shape.cube]\nkind = \"box\"\nsize = " << (dimension == 2 ? "[1, 1]" : "[1, 1, 1]") << "\n";
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double height = 0.5 + heights[i] * std::sqrt(dimension);
    out << fmt::format("[[body]]\nposition = [{}, {}{:.6f}]\n{}\n", 20 * i, dimension == 2 ? "" : "0, ", height, body);
  }
}

Outcome run(const TemporaryFolder& folder, const std::string& options) {
  return talus_command("run " + (folder / "scene.toml") + " --no-telemetry --out " + (folder / "run") + " " + options);
}

Json summary_in(const TemporaryFolder& folder) { return Json::parse(contents(folder.path() / "run" / "summary.json")); }

// A body lands on an engine's contact skin or margin, some millimetres above the ground or in it: 0.015 D.
TEST(MeasureDrift, IsTheHeightAtWhichSleepingBodiesHang) {
  for (const Engine& engine : engines()) {
    SCOPED_TRACE(engine.name);
    const TemporaryFolder folder;
    write_cubes(folder / "scene.toml", engine.dimension, {0.2, 0.0}, "asleep = true");
    const std::string options = std::string("--measure-drift --strict -b ") + engine.name;
    const Outcome outcome = run(folder, options);
    EXPECT_EQ(outcome.exit_code, 1) << "0.1 D on average is above the tolerance of 0.05 D" << outcome.err;
    const Json summary = summary_in(folder);
    const Json& measured = summary["measured"];
    EXPECT_EQ(measured["missing"], "");
    EXPECT_EQ(measured["bodies"], 2);
    EXPECT_DOUBLE_EQ(measured["simulated_s"], 5.0);
    EXPECT_NEAR(measured["drift_max_D"], 0.2, 0.015);
    EXPECT_NEAR(measured["drift_mean_D"], 0.1, 0.015);
    ASSERT_EQ(summary["warnings"].size(), 1U);
    EXPECT_EQ(summary["warnings"][0]["kind"], "drift");
    EXPECT_EQ(summary["warnings"][0]["value"], measured["drift_mean_D"]);
    EXPECT_NE(outcome.err.find("warning: step 4: once woken, the sleeping bodies move by 0.1"), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.out.find("measured: the 2 sleeping bodies move by 0.1"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("; tolerance 0.05 D"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("  warning: once woken"), std::string::npos) << outcome.out;
  }
}

TEST(MeasureDrift, IsNextToNothingForABodyThatRestsHoweverMuchOthersMove) {
  for (const Engine& engine : engines()) {
    SCOPED_TRACE(engine.name);
    const TemporaryFolder folder;
    write_cubes(folder / "scene.toml", engine.dimension, {0.0, 30.0}, "");
    const std::string options = std::string("--set run.frames=120 --measure-drift --strict -b ") + engine.name;
    const Outcome outcome = run(folder, options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json measured = summary_in(folder)["measured"];
    EXPECT_EQ(measured["bodies"], 1) << "the one that falls does not sleep";
    EXPECT_LT(measured["drift_max_D"], 0.01);
  }
}

TEST(MeasureDrift, LeavesOutBodiesThatHaveLeftTheWorld) {
  const TemporaryFolder folder;
  write_cubes(folder / "scene.toml", 2, {0.0}, "");
  std::ofstream(folder.path() / "scene.toml", std::ios::app) << "[[body]]\nposition = [9990, 50]\nvelocity = [90, 0]\n";
  const Outcome outcome = run(folder, "--set run.frames=120 --measure-drift");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json summary = summary_in(folder);
  EXPECT_EQ(summary["bodies_lost"], 1);
  EXPECT_EQ(summary["measured"]["missing"], "");
  EXPECT_EQ(summary["measured"]["bodies"], 1);
}

TEST(MeasureDrift, ChangesNothingOfTheRun) {
  const TemporaryFolder folder;
  const Engine engine = engines().front();
  write_cubes(folder / "scene.toml", engine.dimension, {0.2}, "asleep = true");
  run(folder, "--measure-drift");
  const Json with = summary_in(folder);
  fs::remove_all(folder.path() / "run");
  run(folder, "");
  const Json without = summary_in(folder);
  EXPECT_TRUE(without["measured"].is_null());
  EXPECT_EQ(with["end_hash"], without["end_hash"]);
  EXPECT_EQ(with["steps"], without["steps"]);
}

// Two cubes, one of which hangs at 0.2 D: 0.1 D on average. An engine's skin and margin take up to 0.015 D.
TEST(DriftProbe, OfEachRunUnderAdaptiveTellsTheDriftAndWarnsAboveTheTolerance) {
  for (const Engine& engine : engines()) {
    SCOPED_TRACE(engine.name);
    const TemporaryFolder folder;
    write_cubes(folder / "scene.toml", engine.dimension, {0.2, 0.0}, "asleep = true");
    const Outcome outcome = run(folder, std::string("--strict -b ") + engine.name);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    const Json summary = summary_in(folder);
    const Json& estimate = summary["estimate"];
    EXPECT_NEAR(estimate["drift_D"], 0.1, 0.015);
    EXPECT_LE(estimate["least_D"], estimate["drift_D"]);
    EXPECT_GE(estimate["most_D"], estimate["drift_D"]);
    EXPECT_GT(estimate["probed_s"], 0.0);
    EXPECT_LT(estimate["probed_s"], 2.5) << "half of what --measure-drift takes";
    ASSERT_EQ(summary["warnings"].size(), 1U);
    EXPECT_EQ(summary["warnings"][0]["kind"], "drift");
    EXPECT_EQ(summary["warnings"][0]["value"], estimate["least_D"]) << "what has been seen is certain";
    EXPECT_NE(outcome.out.find("would move by some 0.1"), std::string::npos) << outcome.out;
    const std::string hash = std::string(" --hash -b ") + engine.name;
    EXPECT_EQ(talus_command("run " + (folder / "scene.toml") + hash + " --strict").exit_code, 1) << "without a folder";
    EXPECT_EQ(talus_command("run " + (folder / "scene.toml") + hash).exit_code, 0);
  }
}

TEST(DriftProbe, IsLeftOutOnRequestAndUnderOtherPolicies) {
  for (const char* options : {"--no-drift-probe", "--policy full", "--set policy.adaptive.tolerance=0"}) {
    SCOPED_TRACE(options);
    const TemporaryFolder folder;
    write_cubes(folder / "scene.toml", engines().front().dimension, {0.2}, "asleep = true");
    const Outcome outcome = run(folder, std::string("--strict ") + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json estimate = summary_in(folder)["estimate"];
    EXPECT_TRUE(estimate.is_null() || estimate["probed_s"] == 0.0);
  }
}

TEST(MeasureDrift, HasNoWarningWhereThePolicyHasNoTolerance) {
  const TemporaryFolder folder;
  write_cubes(folder / "scene.toml", engines().front().dimension, {0.2}, "asleep = true");
  const Outcome outcome = run(folder, "--measure-drift --set policy.adaptive.tolerance=0 --strict");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(summary_in(folder)["measured"]["drift_mean_D"], 0.1);
  EXPECT_EQ(outcome.out.find("; tolerance"), std::string::npos) << outcome.out;
}

TEST(MeasureDrift, SaysWhyThereIsNone) {
  const TemporaryFolder folder;
  write_cubes(folder / "scene.toml", engines().front().dimension, {0.0}, "");
  const Outcome outcome = run(folder, "--measure-drift --policy full");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json measured = summary_in(folder)["measured"];
  EXPECT_EQ(measured["missing"], "no body sleeps at the end");
  EXPECT_TRUE(measured["drift_mean_D"].is_null());
  EXPECT_NE(outcome.out.find("drift not measured: no body sleeps"), std::string::npos) << outcome.out;
}

TEST(MeasureDrift, IsRefusedBeforeTheRunWhereItCannotBeMeasured) {
  const TemporaryFolder folder;
  const int dimension = engines().front().dimension;
  const std::string turning = "[[obstacle]]\nkind = \"ball\"\nradius = 1\nposition = " +
                              std::string(dimension == 2 ? "[20, 5]" : "[20, 0, 5]") +
                              "\nname = \"mill\"\nmotion = {kind = \"turn\", speed_deg = 90}\n";
  write_cubes(folder / "scene.toml", dimension, {0.0}, "asleep = true", turning);
  const Outcome outcome = run(folder, "--measure-drift");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--measure-drift: drift cannot be measured: an obstacle or gravity still moves by plan"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
  std::ofstream(folder.path() / "scene.toml", std::ios::app)
      << "[[event]]\ntime = 0.02\ndo = \"remove\"\nobstacle = \"mill\"\n";
  EXPECT_EQ(run(folder, "--measure-drift").exit_code, 0) << "an event removes the obstacle";
  EXPECT_EQ(summary_in(folder)["measured"]["missing"], "");
}

TEST(MeasureDrift, GoesByThePolicyThatEventsLeft) {
  const TemporaryFolder folder;
  write_cubes(folder / "scene.toml", engines().front().dimension, {0.2}, "asleep = true",
              "[[event]]\ntime = 0\ndo = \"policy\"\npolicy = \"paper\"\n");
  const Outcome outcome = run(folder, "");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("sleeping bodies"), std::string::npos) << outcome.out;
  EXPECT_EQ(summary_in(folder)["events"][0]["text"], "policy paper");
}

TEST(MeasureDrift, SaysSoWhereAnEventThatEndsTheMotionHasNotHappened) {
  const TemporaryFolder folder;
  const int dimension = engines().front().dimension;
  write_cubes(folder / "scene.toml", dimension, {0.0}, "asleep = true",
              "[[obstacle]]\nkind = \"ball\"\nradius = 1\nposition = " +
                  std::string(dimension == 2 ? "[20, 5]" : "[20, 0, 5]") +
                  "\nname = \"mill\"\nmotion = {kind = \"turn\", speed_deg = 90}\n"
                  "[[event]]\nwhen = \"rest\"\ndo = \"remove\"\nobstacle = \"mill\"\n");
  const Outcome outcome = run(folder, "--measure-drift");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(summary_in(folder)["measured"]["missing"],
            "an obstacle or gravity still moves by plan at the end, or the force of an event acts");
}

TEST(MeasureDrift, IsAColumnOfASweep) {
  const TemporaryFolder folder;
  write_cubes(folder / "scene.toml", engines().front().dimension, {0.2}, "asleep = true");
  const std::string sweep =
      "sweep " + (folder / "scene.toml") + " --set policy.adaptive.tolerance=0.05,0.1 --out " + (folder / "sweep");
  ASSERT_EQ(talus_command(sweep + " --measure-drift --plot measured_drift_D").exit_code, 0);
  const std::string table = contents(folder.path() / "sweep" / "sweep.csv");
  EXPECT_NE(table.find(",measured_drift_D\n"), std::string::npos) << table;
  const auto last = table.rfind(',');
  EXPECT_NEAR(std::stod(table.substr(last + 1)), 0.2, 0.015) << table;
  EXPECT_EQ(talus_command(sweep).exit_code, 2) << "runs without it would not go into the same table";
}

}  // namespace
}  // namespace talus::measure_drift_test
