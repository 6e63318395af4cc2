// `talus bench` on scenes so small that a run takes a part of a second.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/process/process.h"

namespace talus::bench_command_test {
namespace {

namespace fs = std::filesystem;

const std::string tiny = " --set source[0].count=10 --set run.frames=120 ";

using Row = std::map<std::string, std::string>;

/// The cells of a line; no cell of these tests is quoted.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",end");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  cells.pop_back();
  return cells;
}

std::vector<Row> rows_of(const fs::path& file) {
  std::istringstream lines(contents(file));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> head = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    EXPECT_EQ(cells.size(), head.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(cells.size(), head.size()); ++i) row[head[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

double number(const Row& row, const std::string& column) {
  const std::string& cell = row.at(column);
  return cell.empty() ? std::nan("") : std::stod(cell);
}

class Bench : public ::testing::Test {
 protected:
  std::vector<Row> rows(const std::string& arguments) {
    outcome_ = talus_command("bench " + arguments + " --out " + (folder_ / "b"));
    EXPECT_EQ(outcome_.exit_code, 0) << outcome_.err;
    return rows_of(folder_.path() / "b" / "bench.csv");
  }

  TemporaryFolder folder_;
  Outcome outcome_;
};

TEST_F(Bench, HasARowForEachRunWithSpeedUpAndErrorsAgainstTheReference) {
  const auto all = rows("drop_in_a_pile_2d --policy full,adaptive,reference --seeds 2 --drift" + tiny);
  ASSERT_EQ(all.size(), 6U);
  double reference = 0.0;
  for (const Row& row : all)
    if (row.at("policy") == "reference") reference += 0.5 * number(row, "centre_height_m");
  for (const Row& row : all) {
    EXPECT_EQ(row.at("failure"), "");
    EXPECT_GT(number(row, "seconds"), 0.0);
    EXPECT_EQ(number(row, "bodies"), 10.0);
    // Four seconds. In the reference a body moves at most a quarter of its thickness in a step: 240 steps a second.
    EXPECT_EQ(number(row, "steps"), row.at("policy") == "reference" ? 960.0 : 240.0);
    EXPECT_GE(number(row, "drift_D"), 0.0);
    if (row.at("policy") == "full") EXPECT_EQ(number(row, "speed_up"), 1.0);
    if (row.at("policy") == "full") EXPECT_EQ(number(row, "asleep_at_end"), 0.0);
    if (row.at("policy") == "reference") continue;
    EXPECT_NEAR(number(row, "centre_error_percent"), 100.0 * (number(row, "centre_height_m") / reference - 1.0), 1e-5);
    EXPECT_GT(number(row, "centre_error_se"), 0.0);
  }
  EXPECT_NE(outcome_.out.find(" ± "), std::string::npos) << outcome_.out;
  EXPECT_NE(contents(folder_.path() / "b" / "error-drop_in_a_pile_2d-box2d.svg").find("<svg"), std::string::npos);
}

TEST_F(Bench, GivesTheBitsOfTalusRun) {
  const auto all = rows("drop_in_a_pile_2d --policy adaptive --seeds 2" + tiny);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NE(all[0].at("end_hash"), all[1].at("end_hash"));
  const Outcome run = talus_command("run drop_in_a_pile_2d --no-telemetry --policy adaptive --set seed=2" + tiny +
                                    "--set run.until=frames --out " + (folder_ / "r"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto summary = nlohmann::json::parse(contents(folder_.path() / "r" / "summary.json"));
  EXPECT_EQ(summary.at("end_hash"), all[1].at("end_hash"));
}

TEST_F(Bench, DoesNotRepeatFullForEachValueOfAPolicysSetting) {
  const auto all = rows(
      "drop_in_a_pile_2d --policy full,paper --seeds 1 --set policy.tau=0.1,0.3 --set "
      "ground.friction=0.2:0.6:0.4" +
      tiny);
  ASSERT_EQ(all.size(), 6U) << "for two frictions full once and paper twice";
  for (const Row& row : all) EXPECT_TRUE(std::isfinite(number(row, "speed_up"))) << row.at("settings");
}

TEST_F(Bench, OfTable2SweepsTauBesideThePapersOwnNumbers) {
  const auto all = rows("drop_in_a_pile_2d --preset table2 --quick" + tiny);
  EXPECT_EQ(all.size(), 2U * 6U) << "full and five values of tau";
  EXPECT_EQ(outcome_.out.find("paper: speed-up"), std::string::npos) << "the paper has no such scene in Table 2";
}

TEST_F(Bench, OfTable1HasThePapersOwnNumbersAndItsError) {
  const auto all = rows("varying_drops_2d --preset table1 --policy full,paper --seeds 1 --set run.frames=60");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_GE(number(all[1], "motion_error"), 0.0);
  EXPECT_NE(outcome_.out.find("paper: speed-up"), std::string::npos) << outcome_.out;
  EXPECT_NE(outcome_.out.find("20.8"), std::string::npos) << outcome_.out;
}

TEST_F(Bench, OfAFigureHasTimeAndErrorOfEachFrame) {
  rows("drop_in_a_pile_2d --preset figure5 --policy full,paper --seeds 1" + tiny);
  const auto frames = rows_of(folder_.path() / "b" / "frames.csv");
  EXPECT_EQ(frames.size(), 2U * 119U) << "motions between 120 frames";
  EXPECT_EQ(frames[1].at("time_s").substr(0, 6), "0.0333");
  EXPECT_TRUE(fs::exists(folder_.path() / "b" / "frame_time-drop_in_a_pile_2d-box2d.svg"));
}

TEST_F(Bench, SetsSeedsApartByAMicrometreWhereNothingIsRandom) {
  std::ofstream(folder_.path() / "box.toml") << R"(
title = "A box"
dimension = 2
shape.box = {kind = "box", size = [1, 1]}
body = [{shape = "box", position = [0, 0.5]}]
run.frames = 30
)";
  const auto all = rows((folder_ / "box.toml") + " --policy full --seeds 2");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NE(all[0].at("end_hash"), all[1].at("end_hash"));
}

TEST_F(Bench, SaysInARowWhyItsRunFailedAndKeepsTheOthers) {
  // The limit of processor time, which counts for each process, ends the second run.
  std::ofstream(folder_.path() / "box.toml") << R"(
title = "A box"
dimension = 2
shape.box = {kind = "box", size = [1, 1]}
body = [{shape = "box", position = [0, 0.5]}]
)";
  const Outcome outcome = shell("ulimit -t 2; \"$TALUS\" bench " + (folder_ / "box.toml") +
                                " --policy full --seeds 1 --set run.frames=30,10000000 --out " + (folder_ / "b"));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const auto all = rows_of(folder_.path() / "b" / "bench.csv");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].at("failure"), "");
  EXPECT_NE(all[1].at("failure"), "");
  EXPECT_EQ(all[1].at("end_hash"), "");
  EXPECT_NE(outcome.out.find("2 runs, 1 failed"), std::string::npos) << outcome.out;
}

TEST_F(Bench, KeepsWhatIsInAFolder) {
  fs::create_directories(folder_.path() / "b");
  std::ofstream(folder_.path() / "b" / "bench.csv") << "my own numbers\n";
  const Outcome outcome = talus_command("bench drop_in_a_pile_2d --out " + (folder_ / "b"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("must be new, empty, or of the same benchmark of the same scenes"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(contents(folder_.path() / "b" / "bench.csv"), "my own numbers\n");
}

TEST_F(Bench, GoesOnWithWhatIsNotMeasured) {
  const std::string arguments = "drop_in_a_pile_2d --policy full,adaptive --seeds 2" + tiny;
  const auto first = rows(arguments);
  fs::remove(folder_.path() / "b" / "rows" / "00002.json");
  EXPECT_NE(talus_command("bench --status " + (folder_ / "b")).out.find("4 runs: 3 measured, 0 failed, 1 not measured"),
            std::string::npos);
  const auto second = rows(arguments);
  ASSERT_EQ(second.size(), 4U);
  EXPECT_NE(outcome_.err.find("[1/1] drop_in_a_pile_2d box2d full"), std::string::npos) << outcome_.err;
  for (std::size_t i = 0; i < second.size(); ++i) {
    EXPECT_EQ(second[i].at("end_hash"), first[i].at("end_hash"));
    if (i != 2) EXPECT_EQ(second[i].at("seconds"), first[i].at("seconds"));
  }
  EXPECT_EQ(rows(arguments + " --force").size(), 4U) << "changes no result";
}

TEST_F(Bench, MeasuresAgainWhatAFileHasNoWholeRowOf) {
  const std::string arguments = "drop_in_a_pile_2d --policy full --seeds 4" + tiny;
  rows(arguments);
  const std::map<std::string, std::string> broken = {
      {"00000", ""}, {"00001", "[1]"}, {"00002", R"({"end_hash": "0"})"}};
  for (const auto& [name, text] : broken) std::ofstream(folder_.path() / "b" / "rows" / (name + ".json")) << text;
  const Outcome status = talus_command("bench --status " + (folder_ / "b"));
  EXPECT_NE(status.out.find("4 runs: 1 measured, 0 failed, 3 not measured"), std::string::npos) << status.err;
  EXPECT_EQ(talus_command("bench --collect " + (folder_ / "b")).exit_code, 1);
  for (const Row& row : rows(arguments)) EXPECT_EQ(row.at("failure"), "");
}

TEST_F(Bench, GoesOnWithNoOtherFilesThanItsScenesWereReadFrom) {
  const std::string scene = "title = \"A box\"\ndimension = 2\nshape.box = {kind = \"box\", size = [1, 1]}\n";
  std::ofstream(folder_.path() / "base.toml") << scene << "body = [{shape = \"box\", position = [0, 0.5]}]\n";
  std::ofstream(folder_.path() / "box.toml") << "include = \"base.toml\"\nrun.frames = 5\n";
  const Outcome emitted =
      talus_command("bench " + (folder_ / "box.toml") + " --policy full --seeds 1 --emit " + (folder_ / "b"));
  ASSERT_EQ(emitted.exit_code, 0) << emitted.err;
  std::ofstream(folder_.path() / "base.toml", std::ios::app) << "# more\n";
  for (const char* only : {"", " --only 0"}) {
    const Outcome outcome = talus_command("bench --resume " + (folder_ / "b") + only);
    EXPECT_EQ(outcome.exit_code, 2) << only;
    EXPECT_NE(outcome.err.find("base.toml: must be as it was when the benchmark"), std::string::npos) << outcome.err;
  }
}

// The runs of a seed are one task, so that the times that are compared are of one machine.
TEST_F(Bench, IsAListOfTasksForASchedulerWithTheSameBits) {
  const std::string arguments = "drop_in_a_pile_2d --policy full,adaptive --seeds 2" + tiny;
  const auto here = rows(arguments);
  const Outcome emitted = talus_command("bench " + arguments + " --emit " + (folder_ / "list"));
  EXPECT_NE(emitted.out.find("2 lines, 2 tasks of 1"), std::string::npos) << emitted.out << emitted.err;
  const Outcome early = talus_command("bench --collect " + (folder_ / "list"));
  EXPECT_EQ(early.exit_code, 1);
  EXPECT_NE(early.out.find("4 runs, 0 failed, 4 not measured"), std::string::npos) << early.out;
  const Outcome outcome =
      shell("cd " + folder_.path().string() + " && sh list/array.sh 0 && sh list/array.sh 1 && sh list/collect.sh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto listed = rows_of(folder_.path() / "list" / "bench.csv");
  ASSERT_EQ(listed.size(), here.size());
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_EQ(listed[i].at("end_hash"), here[i].at("end_hash"));
}

}  // namespace
}  // namespace talus::bench_command_test
