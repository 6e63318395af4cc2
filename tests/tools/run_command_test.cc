// The talus command as its users meet it.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/process/process.h"

namespace talus::run_command_test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// The 2D example, short enough for a test, on this build's first engine.
const std::string short_scene = "drop_in_a_pile_2d --no-telemetry --set run.frames=150 ";

TEST(RunCommand, LeavesARunFolderThatExplainsItself) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("run " + short_scene + "--out " + (folder / "run"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name : {"scene.toml", "summary.json", "frames.csv", "pile.svg", "pile.png"})
    EXPECT_GT(fs::file_size(folder.path() / "run" / name), 100U) << name;
  const Json summary = Json::parse(contents(folder.path() / "run" / "summary.json"));
  EXPECT_EQ(summary["reason"], "finished");
  EXPECT_EQ(summary["steps"], 300);
  EXPECT_EQ(summary["policy"], "adaptive");
  EXPECT_GT(summary["bodies"], 20);
  EXPECT_GT(summary["ms_per_step"], 0.0);
  EXPECT_GT(summary["ms_per_phase"]["solve"], 0.0);
  EXPECT_EQ(summary["end_hash"].get<std::string>().size(), 16U);
  EXPECT_NE(outcome.out.find(summary["end_hash"]), std::string::npos);
}

TEST(RunCommand, WarnsOfSizesTooDifferentForOnePile) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command(
      "run several_sizes_2d --no-telemetry --set run.frames=5 --set shape.large.arm_x=3 --out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: shape: bounding boxes differ by a factor of 4.98"), std::string::npos)
      << outcome.err;
}

/// Outside of every engine's window.
const std::string no_tau = "drop_in_a_pile_2d --policy paper --set policy.tau=0 --set run.frames=5 ";

TEST(RunCommand, RefusesASceneOutsideOfTheWindowInWhichResultsHold) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("run " + no_tau + "--no-telemetry --out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("drop_in_a_pile_2d.toml: policy.tau = 0: must be above 0"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("--force runs it"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
  EXPECT_EQ(talus_command("check drop_in_a_pile_2d --set policy.kind=paper --set policy.tau=0").exit_code, 2);
  EXPECT_EQ(talus_command("check drop_in_a_pile_2d --set policy.kind=paper --set policy.tau=0 --force").exit_code, 0);
  EXPECT_EQ(talus_command("view " + no_tau + "--seconds 1").exit_code, 2);
  EXPECT_EQ(talus_command("sweep drop_in_a_pile_2d --set policy.kind=paper --set policy.tau=0,0.4 --out " +
                          (folder / "sweep"))
                .exit_code,
            2);
}

TEST(RunCommand, RunsASceneOutsideOfTheWindowByForceWithAWarningThatStays) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command("run " + no_tau + "--no-telemetry --force --out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string warning = "warning: outside of the window in which results hold: ";
  EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find(warning), std::string::npos) << outcome.out;
  const Json summary = Json::parse(contents(folder.path() / "run" / "summary.json"));
  ASSERT_EQ(summary["outside_window"].size(), 1U);
  EXPECT_EQ(summary["outside_window"][0]["field"], "policy.tau");
  EXPECT_EQ(summary["outside_window"][0]["value"], "0");
}

TEST(Strict, FailsForEveryWarningThatIsPrinted) {
  const TemporaryFolder folder;
  int number = 0;
  for (const char* warned : {"--set source[0].rate=1000",                                             // of the scene
                             "--force --set policy.kind=paper --set policy.tau=0",                    // of the window
                             "--set source[0].position=[9990,5] --set source[0].velocity=[90,0]"}) {  // of the run
    const std::string scene = std::string("drop_in_a_pile_2d --set source[0].count=2 --set run.frames=40 ") + warned;
    for (const std::string& to : {std::string("--hash"), "--out " + (folder / std::to_string(number++))}) {
      const std::string run = "run " + scene + " --no-telemetry " + to;
      EXPECT_EQ(talus_command(run).exit_code, 0) << run;
      fs::remove_all(folder.path() / std::to_string(number - 1));
      const Outcome strict = talus_command(run + " --strict");
      EXPECT_EQ(strict.exit_code, 1) << run;
      EXPECT_NE(strict.err.find("warning: "), std::string::npos) << strict.err;
    }
    if (number == 3) continue;  // `check` does not run it
    EXPECT_EQ(talus_command("check " + scene).exit_code, 0) << scene;
    EXPECT_EQ(talus_command("check --strict " + scene).exit_code, 1) << scene;
  }
  EXPECT_EQ(talus_command("check --strict drop_in_a_pile_2d").exit_code, 0);
}

TEST(RunCommand, WarnsAtOnceAndAtTheEndAndInTheSummaryOfBodiesThatWereLost) {
  const TemporaryFolder folder;
  const std::string thrown =
      "--set source[0].count=1 --set source[0].position=[9990,5] --set source[0].velocity=[90,0] "
      "--set world.steps_per_second=60 ";
  const Outcome outcome = talus_command("run " + short_scene + thrown + "--out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: step 7, body 0: a coordinate is 100"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("warning: 1 body since step 7"), std::string::npos) << outcome.out;
  const Json summary = Json::parse(contents(folder.path() / "run" / "summary.json"));
  EXPECT_EQ(summary["bodies_planned"], 1);
  EXPECT_EQ(summary["bodies_appeared"], 1);
  EXPECT_EQ(summary["bodies_lost"], 1);
  ASSERT_EQ(summary["warnings"].size(), 1U);
  EXPECT_EQ(summary["warnings"][0]["kind"], "outside_world");
  EXPECT_EQ(summary["warnings"][0]["step"], 7);
  EXPECT_EQ(summary["warnings"][0]["body"], 0);
  EXPECT_EQ(summary["warnings"][0]["bodies"], 1);
  EXPECT_GT(summary["warnings"][0]["value"], 10'000.0);
  EXPECT_EQ(talus_command("run " + short_scene + thrown + "--strict --out " + (folder / "strict")).exit_code, 1);
  EXPECT_EQ(talus_command("run " + short_scene + thrown + "--strict --hash").exit_code, 1);
}

TEST(RunCommand, IsContentWithASoundRunEvenWhenStrict) {
  const Outcome outcome = talus_command("run " + short_scene + "--set source[0].count=3 --strict --hash");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
}

#ifndef __SANITIZE_ADDRESS__  // its allocator takes no memory from the heap
TEST(RunCommand, HasItsHeapInHugePagesWhereTheSystemHasThem) {
  if (!fs::exists("/sys/kernel/mm/transparent_hugepage")) return;
  const Outcome outcome = shell(R"(
"$TALUS" run drop_in_a_pile_2d --no-telemetry --policy full --set run.frames=100000 --hash >/dev/null &
process=$!
for attempt in $(seq 500); do
  flags=$(awk '/^[0-9a-f]+-/ {heap = /\[heap\]/} heap && /^VmFlags/ {print}' /proc/$process/smaps)
  grep -q ' hg' <<<"$flags" && break
  sleep 0.01
done
kill -KILL $process
echo "$flags")");
  EXPECT_NE(outcome.out.find(" hg"), std::string::npos) << outcome.out << outcome.err;
}
#endif

TEST(RunCommand, WritesOneRowAStep) {
  const TemporaryFolder folder;
  talus_command("run " + short_scene + "--out " + (folder / "run"));
  const std::string rows = contents(folder.path() / "run" / "frames.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 301);
}

TEST(RunCommand, RecordsTheSceneAsItWasRun) {
  const TemporaryFolder folder;
  const Outcome first =
      talus_command("run " + short_scene + "--set policy.tau=0.3 --seed 7 --hash --out " + (folder / "a"));
  const Outcome again = talus_command("run " + (folder / "a/scene.toml") + " --no-telemetry --hash");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, again.out) << "the recorded scene must give the same run";
}

TEST(RunCommand, GivesTheSameHashInTwoProcessesAndAnotherForAnotherSeed) {
  const Outcome first = talus_command("run " + short_scene + "--hash");
  const Outcome second = talus_command("run " + short_scene + "--hash");
  const Outcome other = talus_command("run " + short_scene + "--hash --seed 2");
  EXPECT_EQ(first.out.size(), 17U);
  EXPECT_EQ(first.out, second.out);
  EXPECT_NE(first.out, other.out);
}

TEST(RunCommand, GivesTheSameHashWithAndWithoutAFolder) {
  const TemporaryFolder folder;
  const Outcome bare = talus_command("run " + short_scene + "--hash");
  const Outcome recorded = talus_command("run " + short_scene + "--hash --out " + (folder / "run"));
  EXPECT_EQ(bare.out, recorded.out);
}

TEST(RunCommand, OverwritesNothing) {
  const TemporaryFolder folder;
  talus_command("run " + short_scene + "--out " + (folder / "run"));
  const std::string before = contents(folder.path() / "run" / "summary.json");
  const Outcome again = talus_command("run " + short_scene + "--seed 2 --out " + (folder / "run"));
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("--out"), std::string::npos);
  EXPECT_EQ(contents(folder.path() / "run" / "summary.json"), before);
}

TEST(RunCommand, TellsTheReasonWhereThereIsNoEndHash) {
  const Outcome outcome = shell(
      "\"$TALUS\" run drop_in_a_pile_2d --policy full --set run.frames=100000 --hash & process=$!; "
      "until grep -q '^SigCgt:.*[2367abef]$' /proc/$process/status; do sleep 0.02; done; "  // until the handler is
                                                                                            // installed
      "kill -INT $process; wait $process");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("no end hash: interrupted"), std::string::npos) << outcome.err;
}

TEST(RunCommand, TimesTwoPoliciesInTurnAndPrintsMedianAndRange) {
  const TemporaryFolder folder;
  const Outcome outcome =
      talus_command("run " + short_scene + "--policy full --against full --out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t line = outcome.out.find(" times as fast as policy full (median; ");
  ASSERT_NE(line, std::string::npos) << outcome.out;
  const double ratio = std::stod(outcome.out.substr(outcome.out.rfind('\n', line) + 1));
  EXPECT_NEAR(ratio, 1.0, 0.5) << "the same policy against itself; other jobs share the processor's caches";
  double low = 0.0;
  double high = 0.0;
  ASSERT_EQ(std::sscanf(outcome.out.c_str() + outcome.out.find("(median; ", line), "(median; %lf to %lf", &low, &high),
            2);
  EXPECT_LE(low, ratio);
  EXPECT_LE(ratio, high);
}

TEST(ListCommand, ShowsEachSceneInOneLine) {
  const Outcome outcome = talus_command("list");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("drop_in_a_pile_2d "), std::string::npos);
  EXPECT_NE(outcome.out.find("drop_in_a_pile_3d "), std::string::npos);
}

TEST(CheckCommand, TellsWhatASceneWillDoWithoutRunningIt) {
  const Outcome outcome = talus_command("check drop_in_a_pile_2d --set source[0].rate=60");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("spout reaches"), std::string::npos);
  EXPECT_NE(outcome.out.find("warning"), std::string::npos) << "60 a second is more than the spout can do";
}

/// Runs a box of 1 m; `world` is the rest of the scene after `[world]`.
Outcome run_box(const std::string& backend, const std::string& world) {
  const TemporaryFolder folder;
  const bool flat = backend == "box2d";
  std::ofstream(folder.path() / "box.toml")
      << "title = \"box\"\ndimension = " << (flat ? 2 : 3)
      << "\nrun = {frames = 2}\nshape.box = {kind = \"box\", size = " << (flat ? "[1, 1]" : "[1, 1, 1]")
      << "}\nbody = [{position = " << (flat ? "[0, 0.5]" : "[0, 0, 0.5]") << "}]\n[world]\n"
      << world;
  return talus_command("run --hash --force --backend " + backend + " " + (folder / "box.toml"));
}

void expect_refused_gravity(const std::string& backend, const std::string& world, const std::string& gravity) {
  const Outcome outcome = run_box(backend, world);
  EXPECT_EQ(outcome.exit_code, 2) << world;
  const std::string expected = "gravity changes by plan or event: world.gravity = " + gravity + ": must be at ";
  EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
}

// Box2D's 2 m a step are 1800 m/s^2 at 30 steps a second, so the limit of all scenes, 1000 m/s^2, comes first.
TEST(RunCommand, RefusesGravityThatBecomesLargerThanAnySceneMayHave) {
  const std::string sine = "gravity = 900\ngravity_motion = {kind = \"sine\", frequency = 1, ";
  expect_refused_gravity("box2d", sine + "amplitude = [0, 200]}\n", "1100");
  EXPECT_EQ(run_box("box2d", sine + "amplitude = [0, 50]}\n").exit_code, 0);
}

#ifdef TALUS_BULLET
// At 60 steps a second a cube of 1 m may fall by 0.2 m a step: 720 m/s^2.
TEST(RunCommand, RefusesGravityThatBecomesTooLargeForBullet) {
  expect_refused_gravity(
      "bullet", "gravity = 10\ngravity_motion = {kind = \"sine\", frequency = 1, amplitude = [0, 0, 900]}\n", "910");
  const std::string path = "gravity_motion = {kind = \"path\", times = [0, 1], gravity = [[0, 0, -10], [0, 0, ";
  expect_refused_gravity("bullet", path + "-950]]}\n", "950");
  expect_refused_gravity("bullet", "[[event]]\ntime = 1\ndo = \"gravity\"\ngravity = [0, 0, -950]\n", "950");
  EXPECT_EQ(run_box("bullet", path + "-700]]}\n").exit_code, 0);
}

TEST(CheckCommand, RefusesWhatNoEngineOfTheDimensionRuns) {
  const std::string pressed = "drop_in_a_pile_3d --set world.gravity=1000 --set world.steps_per_second=60";
  const std::string rule = "world.gravity = 1000: must be at most";
  for (const std::string command : {"check ", "run --hash "}) {
    const Outcome outcome = talus_command(command + pressed);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err.find(rule), std::string::npos) << outcome.err;
  }
}

TEST(RunCommand, WarnsOfWhatIsTooMuchForItsEngine) {
  const TemporaryFolder folder;
  const Outcome outcome = talus_command(
      "run drop_in_a_pile_3d --no-telemetry --set run.frames=2 "
      "--policy full --set source[0].count=20000 --out " +
      (folder / "run"));
  EXPECT_NE(outcome.err.find("warning: bullet: source: 20000 bodies awake at once"), std::string::npos) << outcome.err;
}
#endif

#ifndef __SANITIZE_ADDRESS__
TEST(CheckCommand, RefusesBodiesThatDoNotFitIntoMemory) {
  const std::string many = " drop_in_a_pile_2d --set source[0].count=10000000 --set policy.kind=full";
  for (const std::string command : {"check", "run --hash"}) {
    const Outcome outcome = shell("ulimit -v 4000000; \"$TALUS\" " + command + many);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err.find("source: must drop fewer bodies"), std::string::npos) << outcome.err;
  }
}
#endif

}  // namespace
}  // namespace talus::run_command_test
