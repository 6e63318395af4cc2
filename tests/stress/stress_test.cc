// `talus stress`: its gates on the engines of this build, and what it makes of the results.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "tests/common/temporary_folder.h"
#include "tools/stress/advise.h"
#include "tools/stress/stress_report.h"

namespace talus::stress_test {
namespace {

StressRow row(const std::string& name, const std::string& policy, double measured, StressOutcome outcome) {
  return {"standing", name, "shift", "m", "box2d", policy, measured, 0.0, 0.1, outcome, 0.5, "stands by statics"};
}

TEST(StressQuickGroup, EveryGateHoldsOrIsAKnownLimit) {
  int measured = 0;
  for (const StressRow& each : run_stress({}, 2)) {
    EXPECT_NE(each.outcome, StressOutcome::red) << complaint(each);
    ++measured;
  }
  EXPECT_GT(measured, 100);
}

TEST(StressCases, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const StressCase& each : stress_cases()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_FALSE(each.gates.empty()) << each.name;
    EXPECT_TRUE(each.in_plane || each.in_space) << each.name;
  }
}

TEST(StressCases, AreChosenByGroupOrByName) {
  EXPECT_EQ(chosen_cases({.names = {"stack-40"}, .backends = {}, .policies = {}}).size(), 1U);
  for (const StressCase* each : chosen_cases({.names = {"closed"}, .backends = {}, .policies = {}}))
    EXPECT_EQ(each->group, "closed");
  EXPECT_LT(chosen_cases({}).size(), stress_cases().size());
  EXPECT_EQ(chosen_cases({.names = {}, .backends = {}, .policies = {}, .whole = true}).size(), stress_cases().size());
  EXPECT_THROW(chosen_cases({.names = {"stak"}, .backends = {}, .policies = {}}), std::invalid_argument);
}

TEST(StressGates, HoldWithinTheirTolerance) {
  const StressGate gate{"way", "m", 1.0, 0.1, "theory"};
  EXPECT_TRUE(gate.holds(1.05));
  EXPECT_FALSE(gate.holds(1.2));
  EXPECT_FALSE(gate.holds(std::nan("")));
}

TEST(StressGates, AFailedOneIsReportedWithCaseQuantityReferenceAndTolerance) {
  EXPECT_EQ(complaint(row("stack-5", "full", 0.3, StressOutcome::red)),
            "standing/stack-5 on box2d, full: shift = 0.3 m must be 0 ± 0.1 (stands by statics)");
}

TEST(StressReport, ListsRedCellsWithTheirReason) {
  const Table table =
      red_table({row("stack-5", "full", 0.0, StressOutcome::pass), row("stack-5", "paper", 0.2, StressOutcome::known),
                 row("stack-5", "adaptive", 0.2, StressOutcome::known)});
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0][4], "paper 0.2, adaptive 0.2");
  EXPECT_EQ(table.rows[0].back(), "stands by statics");
}

TEST(StressReport, TellsAtWhichNumbersAFamilyOfCasesPasses) {
  const auto outcome = [](bool pass) { return pass ? StressOutcome::pass : StressOutcome::known; };
  std::vector<StressRow> rows;
  for (const int boxes : {5, 10, 20, 40})
    rows.push_back(row("stack-" + std::to_string(boxes), "full", 0.0, outcome(boxes <= 10)));
  const Table table = window_table(rows);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0][0], "stack");
  EXPECT_EQ(table.rows[0][2], "5 to 10");
}

AdviceRow setting(double rate, int iterations, double off, double seconds) {
  AdviceRow row;
  row.steps_per_second = rate;
  row.iterations = iterations;
  row.centre_off = off;
  row.seconds = seconds;
  return row;
}

TEST(StressAdvice, NamesTheCheapestSettingThatSufficesAndWhatTheScenesOwnWastes) {
  std::vector<AdviceRow> rows = {setting(30, 10, 0.2, 1.0), setting(60, 5, 0.04, 1.5), setting(60, 10, 0.01, 3.0)};
  rows[2].own = true;
  EXPECT_EQ(advice(rows, 0.05),
            "Cheapest that suffices for 0.05 D: 60 steps a second and 5 iterations. The scene's own, 60 steps a second "
            "and 10 iterations, take 2 times its time.");
  EXPECT_NE(advice(rows, 0.02).find("These are the scene's own."), std::string::npos);
  EXPECT_NE(advice(rows, 0.001).find("No setting suffices"), std::string::npos);
}

TEST(StressAdvice, ADifferenceThatChanceExplainsLeavesTheVerdictOpen) {
  AdviceRow row = setting(60, 10, 0.2, 1.0);
  EXPECT_FALSE(row.is_open(0.1));
  row.centre_error = 0.1;
  EXPECT_TRUE(row.is_open(0.1));
  EXPECT_FALSE(row.suffices(0.1));
}

TEST(StressAdvice, ASettingWithAWarningDoesNotSuffice) {
  AdviceRow row = setting(60, 10, 0.0, 1.0);
  EXPECT_TRUE(row.suffices(0.05));
  row.warnings = 1;
  EXPECT_FALSE(row.suffices(0.05));
}

TEST(StressHistory, KeepsTheRowsOfOtherVersionsAndReplacesThoseOfThisOne) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "stress.csv";
  append_history(file, {row("stack-5", "full", 0.01, StressOutcome::pass)});
  std::string text;
  {
    std::ifstream in(file);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::size_t line = text.find('\n') + 1;
  const std::size_t comma = text.find(',', line);
  std::ofstream(file) << text.substr(0, line) << "0.1.0 (old)" << text.substr(comma);
  append_history(file, {row("stack-5", "full", 0.02, StressOutcome::pass)});
  const auto history = append_history(file, {row("stack-5", "full", 0.03, StressOutcome::pass)});
  ASSERT_EQ(history.size(), 2U);
  EXPECT_EQ(history[0].version, "0.1.0 (old)");
  EXPECT_DOUBLE_EQ(history[0].row.measured, 0.01);
  EXPECT_DOUBLE_EQ(history[1].row.measured, 0.03);
  const std::vector<Figure> figures = history_figures(history);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_NE(figures.front().svg.find(">old</text>"), std::string::npos) << "the axis names the versions";
}

TEST(StressHistory, AValueThatDoesNotChangeIsTheSameNumberInEachVersion) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "stress.csv";
  const auto history = append_history(file, {row("stack-5", "full", 1.0 / 3.0, StressOutcome::pass)});
  EXPECT_EQ(history.front().row.measured, read_history(file).front().row.measured);
}

TEST(StressHistory, AnotherFileIsRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "stress.csv") << "a,b\n1,2\n";
  EXPECT_THROW(read_history(folder.path() / "stress.csv"), std::invalid_argument);
}

}  // namespace
}  // namespace talus::stress_test
