// `talus bench`: each benchmark on a scene so small that it takes a second.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/process/process.h"

namespace talus::bench_command_test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string tiny =
    " --quick --rounds 2 --policy paper --set source[0].count=10 --set run.frames=120 --set policy.tau=0.3 ";

std::size_t lines(const fs::path& file) {
  const std::string text = contents(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Runs the benchmark and checks what each of them leaves.
Json results_of(const TemporaryFolder& folder, const std::string& name, const std::string& options) {
  const Outcome outcome = talus_command("bench " + name + tiny + options + " --out " + (folder / name));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("Quick: "), std::string::npos) << "what quick leaves out must be said";
  EXPECT_NE(outcome.err.find(" left\n"), std::string::npos) << "progress with the time left";
  const fs::path out = folder.path() / name;
  const std::string html = contents(out / "report.html");
  EXPECT_NE(html.find("</html>"), std::string::npos);
  EXPECT_NE(html.find("<svg"), std::string::npos) << "plots are part of the page";
  const std::string page = contents(out / "results.md");
  EXPECT_NE(page.find("processor"), std::string::npos);
  EXPECT_NE(page.find("- command: `talus bench " + name + " --quick "), std::string::npos) << page.substr(0, 200);
  EXPECT_NE(page.find("--set 'source[0].count=10' --set run.frames=120"), std::string::npos) << page.substr(0, 200);
  EXPECT_GT(lines(out / "results.csv"), 1U);
  const Json json = Json::parse(contents(out / "results.json"));
  for (const Json& each : json["cases"]) {
    EXPECT_EQ(each["end_hashes"].size(), 1U) << "the same input gives the same end: " << each["policy"];
    EXPECT_GT(each["against_full"]["seconds"], 0.0);
    EXPECT_GT(each["against_full"]["speed_up"], 0.0);
    for (const auto& [measure, value] : each["against_full"].items())
      EXPECT_TRUE(std::isfinite(value.get<double>())) << measure;
  }
  return json;
}

TEST(BenchTable1, ShowsErrorsFloorsAndHindsightBesideEachSpeedUp) {
  const TemporaryFolder folder;
  const Json json = results_of(folder, "table1", "--scene drop_in_a_pile_2d --reference");
  ASSERT_EQ(json["cases"].size(), 5U) << "full, engine, paper, reference, engine_default";
  const Json& full = json["cases"][0];
  EXPECT_EQ(full["policy"], "full");
  EXPECT_EQ(full["against_full"]["speed_up"], 1.0);
  EXPECT_GE(full["against_full"]["hindsight_005"], 1.0);
  const Json& paper = json["cases"][2];
  EXPECT_EQ(paper["policy"], "paper");
  for (const char* name : {"relative", "relative_floor", "R", "R_floor", "R_ceiling", "S", "drift_mean_D", "floating",
                           "ks_z", "w1_r", "centre_off_D", "penetration_p99_D", "work_skipped", "hindsight_005"}) {
    EXPECT_TRUE(paper["against_full"].contains(name)) << name;
    EXPECT_TRUE(paper["against_reference"].contains(name)) << name;
  }
  EXPECT_GT(paper["against_full"]["work_skipped"], 0.0);
  EXPECT_GT(full["against_reference"]["R"], 0.0) << "the full run at other settings is not the reference";
  const Json& engine_default = json["cases"][4];
  EXPECT_EQ(engine_default["policy"], "engine_default");
  EXPECT_TRUE(engine_default["against_reference"].contains("ks_z"));
  EXPECT_NE(engine_default["end_hashes"], json["cases"][1]["end_hashes"])
      << "the scene's settings are not the engine's own";
}

TEST(BenchTable1, GoesOnWhereItStoppedAndMeasuresNothingTwice) {
  const TemporaryFolder folder;
  const std::string options = "--scene drop_in_a_pile_2d";
  results_of(folder, "table1", options);
  const fs::path rows = folder.path() / "table1" / "rows.jsonl";
  const std::string all = contents(rows);
  EXPECT_EQ(lines(rows), 3U * 3U) << "of three policies two rounds and the errors";
  const Outcome again = talus_command("bench table1" + tiny + options + " --out " + (folder / "table1"));
  EXPECT_EQ(again.err.find(", round"), std::string::npos) << again.err;
  EXPECT_EQ(contents(rows), all);
  std::ofstream(rows) << all.substr(0, all.size() - 20);  // killed while it wrote the last row
  const Outcome resumed = talus_command("bench table1" + tiny + options + " --out " + (folder / "table1"));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("[1/1]"), std::string::npos) << "one row was missing: " << resumed.err;
  EXPECT_EQ(lines(rows), 3U * 3U);
}

TEST(BenchTable2, SweepsTauOnAnyScene) {
  const TemporaryFolder folder;
  const Json json = results_of(folder, "table2", "--scene drop_in_a_pile_2d");
  EXPECT_EQ(json["cases"].size(), 6U) << "full and five values of tau";
}

TEST(BenchFigures, LeavesTimeAndErrorOfEachFrame) {
  const TemporaryFolder folder;
  results_of(folder, "figures", "--scene drop_in_a_pile_2d");
  EXPECT_EQ(lines(folder.path() / "figures" / "frames-drop_in_a_pile_2d-box2d-paper.csv"), 60U);
}

TEST(BenchPareto, MovesOneParameterAtATime) {
  const TemporaryFolder folder;
  const Json json = results_of(folder, "pareto", "--scene drop_in_a_pile_2d");
  EXPECT_EQ(json["cases"].size(), 7U) << "full, engine, iterations twice, one time step, tau twice";
}

#ifdef TALUS_BULLET
TEST(BenchEngines, SetsTheEnginesSideBySide) {
  const TemporaryFolder folder;
  const Outcome outcome =
      talus_command("bench engines" + tiny + "--scene drop_in_a_pile_2d --seeds 2 --out " + (folder / "engines"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(contents(folder.path() / "engines" / "results.json"));
  ASSERT_EQ(json["cases"].size(), 6U);
  EXPECT_EQ(json["cases"][0]["backend"], "box2d");
  EXPECT_EQ(json["cases"][3]["backend"], "bullet-planar");
  EXPECT_EQ(json["cases"][5]["against_full"]["runs"], 2.0);
}
#endif

TEST(BenchConvergence, ComparesEachSettingWithTheFinest) {
  const TemporaryFolder folder;
  const Json json = results_of(folder, "convergence", "--scene drop_in_a_pile_2d --backend box2d");
  ASSERT_EQ(json["cases"].size(), 3U);
  EXPECT_EQ(json["cases"][0]["against_full"]["profile_rms_D"], 0.0) << "the finest has no distance from itself";
  EXPECT_GT(json["cases"][1]["against_full"]["profile_rms_D"], 0.0);
}

TEST(BenchSkips, SaysOfEachDebugOptionWhetherTheBitsStay) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command(
      "bench skips --quick --rounds 1 --scene drop_in_a_pile_2d --set source[0].count=10 --set "
      "run.frames=120 --out " +
      (folder / "skips"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(contents(folder.path() / "skips" / "results.json"));
  ASSERT_EQ(json["cases"].size(), 13U) << "without options, and with twelve in turn";
  const Json& without = json["cases"][0];
  EXPECT_EQ(without["policy"], "adaptive");
  EXPECT_GT(without["against_full"]["seconds"], 0.0);
  for (const Json& each : json["cases"]) {
    if (each["settings"].back() == "debug.sweep_slow_bodies=true") continue;
    EXPECT_EQ(each["end_hashes"], without["end_hashes"]) << each["settings"];
  }
  EXPECT_NE(outcome.out.find("sweep_slow_bodies"), std::string::npos);
}

TEST(BenchRest, TellsHowSoonAllSleep) {
  const TemporaryFolder folder;
  const Outcome outcome =
      talus_command("bench rest --quick --policy adaptive --scene drop_in_a_pile_2d --set source[0].count=5 --out " +
                    (folder / "rest"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string table = contents(folder.path() / "rest" / "results.md");
  EXPECT_NE(table.find("| drop_in_a_pile_2d | box2d | 5 | engine |"), std::string::npos) << table;
  EXPECT_NE(table.find("| drop_in_a_pile_2d | box2d | 5 | adaptive |"), std::string::npos) << table;
}

TEST(BenchRate, PoursAtSeveralRates) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command(
      "bench rate --quick --rounds 1 --no-errors --policy paper --scene drop_in_a_pile_2d --out " + (folder / "rate"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(contents(folder.path() / "rate" / "results.json"));
  ASSERT_EQ(json["cases"].size(), 9U) << "full, engine and paper at three rates";
  EXPECT_EQ(json["cases"][0]["against_full"]["bodies"], json["cases"][8]["against_full"]["bodies"]);
}

TEST(BenchScale, TellsWhatSleepersCost) {
  const TemporaryFolder folder;
  const Outcome outcome =
      talus_command("bench scale --quick --backend box2d --scene drop_in_a_pile_2d --out " + (folder / "scale"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("10000"), std::string::npos);
  EXPECT_NE(contents(folder.path() / "scale" / "report.html").find("never frozen"), std::string::npos);
}

TEST(Bench, RefusesBadInput) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = shell("cd " + folder.path().string() + " && \"$TALUS\" bench " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("table1 --scene drop_in_a_pil", "drop_in_a_pile");
  refused("table1 --scene drop_in_a_pile_2d --policy pape --quick", "--policy");
  refused("table1 --rounds -1", "--rounds");
  refused("table1 --share 1.5", "--share");
  refused("table7", "table7");
}

TEST(Bench, RefusesRowsOfAnotherKindAndKeepsThem) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "rows.jsonl") << "my own numbers\n";
  const Outcome outcome =
      talus_command("bench table1 --quick --scene drop_in_a_pile_2d --out " + folder.path().string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("rows.jsonl:1: "), std::string::npos) << outcome.err;
  EXPECT_EQ(contents(folder.path() / "rows.jsonl"), "my own numbers\n");
}

TEST(Bench, WritesMarkdownWithItsFiguresForManuals) {
  const TemporaryFolder folder;
  results_of(folder, "table2", "--scene drop_in_a_pile_2d --no-errors --docs " + (folder / "docs"));
  const std::string page = contents(folder.path() / "docs" / "table2.md");
  EXPECT_NE(page.find("](table2-1.svg)"), std::string::npos) << page;
  EXPECT_NE(contents(folder.path() / "docs" / "table2-1.svg").find("<svg"), std::string::npos);
}

TEST(BenchTruth, MeasuresACellAndGoesOnWhereItStopped) {
  const TemporaryFolder folder;
  const std::string command = "bench truth --quick --bodies 10 --seeds 2 --cells 2d-f0.6-L-at_once-flat-g9.81 --out " +
                              (folder / "truth") + " --set policy.adaptive.";
  const Outcome outcome = talus_command(command + "wake_height=0.02");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const fs::path out = folder.path() / "truth";
  EXPECT_EQ(lines(out / "rows.jsonl"), 2U * 3U) << "two seeds of full, reference and adaptive";
  EXPECT_NE(outcome.out.find("2d-f0.6-L-at_once-flat-g9.81"), std::string::npos);
  EXPECT_TRUE(fs::exists(out / "pictures" / "2d-f0.6-L-at_once-flat-g9.81-box2d-adaptive.png"));
  const Json json = Json::parse(contents(out / "results.json"));
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["seeds"], 2);
  EXPECT_GT(json[0]["speed_up_min"], 0.0);
  EXPECT_LE(json[0]["speed_up_min"], json[0]["speed_up"]);
  EXPECT_LE(json[0]["speed_up"], json[0]["speed_up_max"]);
  EXPECT_NE(contents(out / "report.html").find("wake_height=0.02"), std::string::npos);
  EXPECT_NE(contents(out / "results.md").find("\n| box2d | 1 |"), std::string::npos) << "the table by engine";
  EXPECT_EQ(talus_command(command + "wake_height=0.02").err, "") << "nothing is measured twice";
  EXPECT_EQ(talus_command(command + "wake_height=0.04").exit_code, 0);
  EXPECT_EQ(lines(out / "rows.jsonl"), 2U * 4U) << "full and the reference are kept";
  const Outcome ran = talus_command("check " + (out / "scenes" / "2d-f0.6-L-at_once-flat-g9.81.toml").string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST(BenchTruth, MeasuresASceneFileForAsLongAsItsFramesTake) {
  const TemporaryFolder folder;
  std::ofstream(folder / "two_boxes.toml") << R"(
title = "Two boxes"
dimension = 2
shape.box = {kind = "box", size = [1, 1]}
run.frames = 90

[[body]]
position = [0, 0.5]
repeat = [1, 2]
step = [0, 1]
)";
  const Outcome outcome = talus_command("bench truth --quick --seeds 2 --scenes " + folder.path().string() + " --out " +
                                        (folder / "truth"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(contents(folder.path() / "truth" / "results.json"));
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["cell"], "two_boxes");
  EXPECT_EQ(json[0]["seeds"], 2);
  EXPECT_NE(contents(folder.path() / "truth" / "rows.jsonl").find("\"steps\":180"), std::string::npos);
}

TEST(BenchTruth, AFileNamedLikeASceneOfThePaperKeepsItsFrames) {
  const TemporaryFolder folder;
  std::ofstream(folder / "drop_in_a_pile_2d.toml") << R"(
title = "A box"
dimension = 2
shape.box = {kind = "box", size = [1, 1]}
run.frames = 90

[[body]]
position = [0, 0.5]
)";
  const Outcome outcome = talus_command("bench truth --quick --seeds 2 --scenes " + folder.path().string() + " --out " +
                                        (folder / "truth"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(contents(folder.path() / "truth" / "rows.jsonl").find("\"steps\":180"), std::string::npos);
}

TEST(BenchTruth, WhatIsNoSceneIsRefused) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("bench truth --scenes " + folder.path().string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("no .toml file in it"), std::string::npos) << outcome.err;
}

TEST(BenchTruth, TheNumberOfJobsDoesNotChangeTheResults) {
  const TemporaryFolder folder;
  std::vector<Json> results;
  for (const std::string jobs : {"1", "3"}) {
    const std::string out = folder / jobs;
    ASSERT_EQ(talus_command("bench truth --quick --bodies 10 --seeds 3 --cells 2d-f0.6-L-at_once-flat-g9.81 --jobs " +
                            jobs + " --out " + out)
                  .exit_code,
              0);
    results.push_back(Json::parse(contents(out + "/results.json"))[0]);
    for (const char* time : {"speed_up", "speed_up_min", "speed_up_max", "speed_up_reference"})
      results.back().erase(time);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(BenchTruth, ABadSettingIsRefusedBeforeAnyRun) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("bench truth --quick --set policy.adaptive.no=1 --out " + (folder / "truth"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("policy.adaptive.no = 1: no such key"), std::string::npos) << outcome.err;
}

TEST(BenchTruth, ACellThatDoesNotExistIsRefused) {
  const Outcome outcome = talus_command("bench truth --cells 5d");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--cells 5d"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::bench_command_test
