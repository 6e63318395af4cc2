// docs/files.md against what the commands write.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/policy/frame.h"
#include "common/policy/sleep_event.h"
#include "tests/common/documented_names.h"
#include "tests/process/process.h"
#include "tools/bench/bench_run.h"

namespace talus::documented_files_test {
namespace {

using Json = nlohmann::json;
/// A scene in which one brick passes a gate and another rests before it, so that the gate counts as jammed.
constexpr const char* instruments =
    "shape.brick = {kind = \"box\", size = [1, 1]}\n"
    "obstacle = [{name = \"shelf\", kind = \"box\", size = [4, 1], position = [8, 2]}]\n"
    "gate = [{name = \"between\", corners = [[7, 3.5], [9, 3.5]], jam_after = 2}]\n"
    "region = [{name = \"shelf\", box = [[6, 2.5], [10, 5]]}]\n"
    "load = [{name = \"shelf\", on = \"shelf\", heights = [0, 3]}]\n"
    "world.solver.kind = \"small_steps\"\npolicy.adaptive.rings = 2\n";

/// Three discs fall, in steps longer than the engine's window has them; one is thrown beyond the world's edge, which
/// gives a warning. The folder that the run leaves.
std::filesystem::path run_in(const TemporaryFolder& folder) {
  std::ofstream(folder.path() / "scene.toml")
      << "title = \"three discs and one that is lost\"\n"
         "dimension = 2\n"
         "shape.disc = {kind = \"ball\", radius = 0.5, rolling_friction = 0.3}\n"
         "shape.small = {kind = \"ball\", radius = 0.2, density = 6000}\n"
      << instruments
      << "source = [{shape = \"brick\", count = 2, rate = 1, position = [8, 4.5], spread = [0, 0], angle_deg = 0},\n"
         "          {shape = \"disc\", count = 3, rate = 10, position = [0, 3]},\n"
         "          {shape = \"small\", count = 1, rate = 10, position = [9990, 5], velocity = [50, 0]}]\n"
         "pile = [{alpha_deg = 30, at = [0, 0]}]\n"
         "event = [{time = 0.5, do = \"wake\"}, {time = 1.9, do = \"remove\", shape = \"small\"}]\n"
         "run = {frames = 120, frame_rate = 30}\n"
         "world.steps_per_second = 30\n";
  const Outcome outcome =
      talus_command("run " + (folder / "scene.toml") +
                    " --no-telemetry --backend bullet-planar --force --measure-drift --out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return folder.path() / "run";
}

/// First line of a file.
std::string header_of(const std::filesystem::path& file) {
  const std::string text = contents(file);
  return text.substr(0, text.find('\n'));
}

Names split(const std::string& header) {
  std::istringstream cells(header);
  Names columns;
  for (std::string cell; std::getline(cells, cell, ',');) columns.insert(cell);
  return columns;
}

TEST(DocumentedFiles, HaveAllColumnsOfFramesCsv) {
  const TemporaryFolder folder;
  expect_documented(split(header_of(run_in(folder) / "frames.csv")), "frames.csv");
}

TEST(DocumentedFiles, HaveAllColumnsOfInstruments) {
  const TemporaryFolder folder;
  const std::filesystem::path run = run_in(folder);
  for (const char* name : {"gates.csv", "regions.csv"}) expect_documented(split(header_of(run / name)), name);
  const Outcome outcome = talus_command(
      "run drop_in_a_pile_3d --no-telemetry --set run.frames=2 --set 'load=[{name=\"below\", on=\"ground\", "
      "heights=[-1, 1]}]' --out " +
      (folder / "run3d"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  Names columns = split(header_of(run / "loads.csv"));
  columns.merge(split(header_of(folder.path() / "run3d" / "loads.csv")));
  expect_documented(columns, "loads.csv");
  columns = split(header_of(run / "profiles.csv"));
  columns.merge(split(header_of(folder.path() / "run3d" / "profiles.csv")));
  expect_documented(columns, "profiles.csv");
}

TEST(DocumentedFiles, HaveAllColumnsOfSweepCsv) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("sweep drop_in_a_pile_2d --set run.frames=2,3 --out " + (folder / "sweep"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  Names columns = split(header_of(folder.path() / "sweep" / "sweep.csv"));
  columns.erase("run.frames");
  expect_documented(columns, "sweep.csv");
}

TEST(DocumentedFiles, GiveEachPhaseOfAStepTheMeaningOfItsDeclaration) {
  const std::string page = contents(std::string(TALUS_SOURCE_DIR) + "/docs/files.md");
  for (const Phase& phase : all_phases) {
    const std::string row = "| `" + std::string(phase.name) + "_ms` | " + std::string(phase.meaning) + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(DocumentedFiles, HaveAllKeysOfSummaryJson) {
  const TemporaryFolder folder;
  Names keys;
  collect(Json::parse(contents(run_in(folder) / "summary.json")), "", keys);
  expect_documented(keys, "summary.json");
}

#ifdef TALUS_LCM

/// The keys that a command prints with --json.
Names keys_printed(const std::string& arguments) {
  const Outcome outcome = talus_command(arguments + " --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  Names keys;
  collect(Json::parse(outcome.out), "", keys);
  return keys;
}

/// Records eight seconds of a pour.
void record(const std::string& folder, const std::string& policy) {
  const Outcome outcome = talus_command(
      "run drop_in_a_pile_2d --no-telemetry --set run.frames=240 --set policy.tau=0.2 "
      "--policy " +
      policy + " --out " + folder);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(RecordedInstruments, EndWithTheNumbersOfTheSummary) {
  const TemporaryFolder folder;
  const std::filesystem::path run = run_in(folder);
  const Outcome outcome = talus_command("info " + run.string() + " --messages --channel TALUS_INSTRUMENTS");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string lines = outcome.out.substr(0, outcome.out.find_last_not_of('\n') + 1);
  const Json last = Json::parse(lines.substr(lines.rfind('\n') + 1))["message"];
  const Json summary = Json::parse(contents(run / "summary.json"));
  EXPECT_EQ(last["gates"][0]["forward"], summary["gates"][0]["forward"]);
  EXPECT_EQ(last["gates"][0]["jammed"], summary["gates"][0]["jammed"]);
  EXPECT_EQ(last["regions"][0]["bodies"], summary["regions"][0]["bodies"]);
  EXPECT_EQ(last["regions"][0]["packing"], summary["regions"][0]["packing"]);
  EXPECT_EQ(last["loads"][0]["force"][2], summary["loads"][0]["at_end"]["force_N"][1]);
}

TEST(DocumentedFiles, HaveAllKeysOfCompare) {
  const TemporaryFolder folder;
  record(folder / "full", "full");
  record(folder / "paper", "paper");
  Names compared = keys_printed("compare --twins 1 " + (folder / "full") + " " + (folder / "paper"));
  compared.insert({"a.lost_steps[]", "b.lost_steps[]"});  // empty, since the records are whole
  expect_documented(compared, "talus compare --json");
}

#endif

TEST(DocumentedFiles, HaveAllColumnsOfBenchmarks) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command(
      "bench drop_in_a_pile_2d --preset figure5 --policy full --seeds 1 --set source[0].count=10 --set run.frames=60 "
      "--out " +
      (folder / "b"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_documented(split(header_of(folder.path() / "b" / "bench.csv")), "bench.csv");
  Names of_frames = split(header_of(folder.path() / "b" / "frames.csv"));
  for (const char* of_the_run : {"scene", "backend", "policy", "settings", "seed"}) of_frames.erase(of_the_run);
  expect_documented(of_frames, "bench's frames.csv");
}

TEST(DocumentedFiles, HaveTheNumbersOfBenchmarksAsTheyAreDeclared) {
  const std::string page = contents(std::string(TALUS_SOURCE_DIR) + "/docs/files.md");
  for (const BenchColumn& column : bench_columns) {
    const std::string row = "| `" + std::string(column.name) + "` | " + std::string(column.meaning) + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

// The page explains a cause by its name.
TEST(DocumentedFiles, AndThePageHaveEachCauseOfSleep) {
  const std::string manual = contents(std::string(TALUS_SOURCE_DIR) + "/docs/record.md");
  const std::string page = contents(std::string(TALUS_SOURCE_DIR) + "/tools/view/page/src/causes.ts");
  for (const std::string& cause : cause_names()) {
    EXPECT_NE(manual.find("\n| `" + cause + "` | "), std::string::npos) << cause;
    const std::string key = cause.find(' ') == std::string::npos ? cause : '"' + cause + '"';
    EXPECT_NE(page.find("\n  " + key + ": {"), std::string::npos) << cause;
  }
}

}  // namespace
}  // namespace talus::documented_files_test
