// The cases of tests/physics on every engine of this build, and `talus stress`.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "common/scene/window.h"
#include "tests/physics/physics_case.h"
#include "tests/process/process.h"
#include "tools/run/backends.h"

namespace talus::stress_test {
namespace {

std::vector<PhysicsTask> tasks(bool slow) {
  std::vector<PhysicsTask> chosen = physics_tasks();
  std::erase_if(chosen, [&](const PhysicsTask& task) { return task.each->slow != slow; });
  return chosen;
}

std::string name_of(const ::testing::TestParamInfo<PhysicsTask>& info) {
  std::string name = info.param.each->name;
  name.append("_").append(info.param.cell.backend).append("_").append(info.param.cell.policy);
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return name;
}

class Physics : public ::testing::TestWithParam<PhysicsTask> {};
class LongPhysics : public Physics {};

void expect_gates_hold(const PhysicsTask& task) {
  const std::vector<double> measured = task.measure();
  ASSERT_EQ(measured.size(), task.each->gates.size());
  for (std::size_t i = 0; i < measured.size(); ++i)
    EXPECT_TRUE(task.each->gates[i].holds(measured[i])) << sentence(task, task.each->gates[i], measured[i]);
}

TEST_P(Physics, HoldsWithinItsTolerances) { expect_gates_hold(GetParam()); }
TEST_P(LongPhysics, HoldsWithinItsTolerances) { expect_gates_hold(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, Physics, ::testing::ValuesIn(tasks(false)), name_of);
INSTANTIATE_TEST_SUITE_P(Cases, LongPhysics, ::testing::ValuesIn(tasks(true)), name_of);

TEST(PhysicsCases, HaveNamesOfTheirOwnAndAGroup) {
  std::set<std::string> names;
  const std::vector<std::string_view> groups = physics_groups();
  for (const PhysicsCase& each : physics_cases()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_NE(std::ranges::find(groups, each.group), groups.end()) << each.name;
    EXPECT_FALSE(each.gates.empty()) << each.name;
    EXPECT_TRUE(each.in_plane || each.in_space) << each.name;
  }
}

TEST(PhysicsGates, HoldWithinTheirTolerance) {
  const PhysicsGate gate{"way", "m", 1.0, 0.1, "theory"};
  EXPECT_TRUE(gate.holds(1.05));
  EXPECT_FALSE(gate.holds(1.2));
  EXPECT_FALSE(gate.holds(std::nan("")));
}

TEST(PhysicsGates, AFailedOneIsReportedWithCaseQuantityReferenceAndTolerance) {
  const PhysicsCase stack{.group = "standing", .name = "stack-5", .setup = "", .gates = {}};
  const PhysicsGate gate{"shift", "m", 0.0, 0.1, "stands by statics"};
  EXPECT_EQ(sentence({&stack, {"box2d", "full"}}, gate, 0.3),
            "stack-5 on box2d, full: shift = 0.3 m must be 0 ± 0.1 (stands by statics)");
}

/// The rows of the window table for an engine.
void expect_documented(const std::string& page, const EngineTraits& engine) {
  for (const WindowRule& rule : window_rules(engine)) {
    const std::string row = "| " + std::string(engine.name) + " | `" + rule.field + "` | " + rule.rule + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(LimitsPage, HasTheWindowOfEachEngine) {
  const std::string page = contents(TALUS_SOURCE_DIR "/docs/limits.md");
  for (const std::string& engine : backends(2)) expect_documented(page, engine_traits<2>(engine));
  for (const std::string& engine : backends(3)) expect_documented(page, engine_traits<3>(engine));
}

TEST(StressCommand, PrintsEachMeasuredNumberBesideWhatItMustBe) {
  const Outcome outcome = talus_command("stress free-flight dominoes --backend box2d");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("free-flight: a ball thrown upwards"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("dominoes left standing"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("9 numbers measured, 0 outside of their tolerances"), std::string::npos) << outcome.out;
}

TEST(StressCommand, PutsSolversSideBySide) {
  const Outcome outcome =
      talus_command("stress free-flight --backend box2d --policy full --solver small_steps --solver engine");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("box2d         full      small_steps  "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("box2d         full      engine       "), std::string::npos) << outcome.out;
}

TEST(StressCommand, RefusesWhatIsNeitherAGroupNorACase) {
  const Outcome outcome = talus_command("stress stak-5");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("stak-5: must be a group (closed, standing"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::stress_test
