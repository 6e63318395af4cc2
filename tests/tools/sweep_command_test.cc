// `talus sweep` in a process of its own, and its plan.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/process/process.h"

namespace talus::sweep_command_test {
namespace {

namespace fs = std::filesystem;

/// A sweep of two frictions, two policies and two seeds of ten discs.
class SweepCommand : public ::testing::Test {
 protected:
  SweepCommand() {
    std::ofstream(folder_.path() / "scene.toml")
        << "title = \"Ten discs\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
           "source = [{count = 10, rate = 6, position = [0, 8], velocity = [0, -7]}]\nrun = {frames = 60}\npile = "
           "[{}]\n";
  }
  Outcome sweep(const std::string& more = "") const {
    return talus_command("sweep " + (folder_ / "scene.toml") +
                         " --set shape.disc.friction=0.2:0.6:0.4 --set policy.kind=full,adaptive --seeds 2 --jobs 2 "
                         "--out " +
                         (folder_ / "sweep") + more);
  }
  Outcome in_sweep(const std::string& script) const { return shell("cd " + (folder_ / "sweep") + "\n" + script); }
  Outcome emit(const std::string& more = "") const {
    return talus_command("sweep " + (folder_ / "scene.toml") + " --set shape.disc.friction=0.2,0.6 --seeds 2 --emit " +
                         (folder_ / "sweep") + " --chunk 3 --sbatch '--time=5 --comment=\"a b\"'" + more);
  }
  std::string file(const char* name) const { return contents(folder_.path() / "sweep" / name); }

  TemporaryFolder folder_;
};

TEST_F(SweepCommand, RunsTheProductAndLeavesATableAndAPlot) {
  const Outcome outcome = sweep(" --plot bodies");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("8 runs, 8 finished, 0 failed"), std::string::npos) << outcome.out;
  const std::string table = file("sweep.csv");
  EXPECT_TRUE(table.starts_with("run,shape.disc.friction,policy.kind,seed,reason,end_hash,")) << table;
  EXPECT_EQ(std::ranges::count(table, '\n'), 9);
  EXPECT_NE(table.find("\n0,0.2,full,1,finished,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n7,0.6,adaptive,2,finished,"), std::string::npos) << table;
  EXPECT_NE(file("sweep.svg").find("policy.kind = adaptive"), std::string::npos);
  EXPECT_NE(file("sweep.svg").find("bars: standard error of the mean of 2 seeds"), std::string::npos);
}

TEST_F(SweepCommand, FailsWhereNoRunHasWhatIsPlottedAndSaysSoWithEachRun) {
  const Outcome outcome = sweep(" --plot /nowhere/0");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("1 of 8: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("no number /nowhere/0 for --plot\n2 of 8: "), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, SaysWhyThereIsNoPlot) {
  const Outcome outcome =
      talus_command("sweep " + (folder_ / "scene.toml") + " --seeds 2 --out " + (folder_ / "sweep"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no sweep.svg: no key but seed has several values"), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, PrintsAnyNumberOfTheSummaryWithItsErrorOverTheSeeds) {
  const Outcome outcome = sweep(" --plot /bodies");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("policy.kind = full, shape.disc.friction = 0.2: /bodies 10 +- 0, 2 runs\n"),
            std::string::npos)
      << outcome.out;
  const std::string table = file("sweep.csv");
  EXPECT_TRUE(table.substr(0, table.find('\n')).ends_with(",/bodies")) << table;
  EXPECT_NE(file("sweep.svg").find("/bodies"), std::string::npos);
  for (const std::string key : {"/bodies/0", "/warnings/7", "/warnings/01", "/warnings/99999999999999999999"}) {
    const Outcome missing = talus_command("sweep --collect " + (folder_ / "sweep") + " --plot " + key);
    EXPECT_EQ(missing.exit_code, 1) << key;
    EXPECT_NE(missing.err.find("--plot = " + key + ": no summary.json has such a number\n"), std::string::npos)
        << missing.err;
  }
  const Outcome unknown = talus_command("sweep --collect " + (folder_ / "sweep") + " --plot body");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("must be a key of summary.json, as /gates/0/net, or one of bodies,"), std::string::npos)
      << unknown.err;
}

TEST_F(SweepCommand, GivesTheBitsOfSingleRuns) {
  ASSERT_EQ(sweep().exit_code, 0);
  const Outcome single = talus_command("run " + (folder_ / "scene.toml") +
                                       " --set shape.disc.friction=0.6 --set policy.kind=adaptive --seed 2 --hash");
  const std::string hash = single.out.substr(0, 16);
  EXPECT_NE(file("sweep.csv").find("7,0.6,adaptive,2,finished," + hash), std::string::npos) << hash;
}

TEST_F(SweepCommand, GoesOnWhereItWasStopped) {
  ASSERT_EQ(sweep().exit_code, 0);
  const std::string before = file("sweep.csv");
  fs::remove(folder_.path() / "sweep" / "run_0003" / "summary.json");
  const auto first = fs::last_write_time(folder_.path() / "sweep" / "run_0000" / "summary.json");
  const Outcome outcome = sweep();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("1 of 1: run_0003"), std::string::npos) << outcome.err;
  EXPECT_EQ(fs::last_write_time(folder_.path() / "sweep" / "run_0000" / "summary.json"), first);
  EXPECT_EQ(std::ranges::count(file("sweep.csv"), '\n'), std::ranges::count(before, '\n'));
}

TEST_F(SweepCommand, SaysWhatCtrlCDoesStopsItsRunsAndGoesOnLater) {
  const std::string command = "sweep " + (folder_ / "scene.toml") +
                              " --set run.frames=100000 --set world.gravity=5,6,7,8 --policy full --set run.pace=1 "
                              "--jobs 2 --out " +
                              (folder_ / "sweep");
  const Outcome outcome = shell("cd '" + folder_.path().string() + "'; \"$TALUS\" " + command +
                                " & sweep=$!; for run in run_0000 run_0001; do "
                                "until ls sweep/at_work/$run*/frames.csv 2>/dev/null >&2; do sleep 0.02; done; done; "
                                "kill -INT $sweep; wait $sweep; exit $?");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find("interrupted: no run begins any more"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("4 runs, 0 finished, 0 failed"), std::string::npos) << outcome.out;
  EXPECT_FALSE(fs::exists(folder_.path() / "sweep" / "run_0002"));
  EXPECT_NE(file("run_0000/summary.json").find("\"interrupted\""), std::string::npos);
}

TEST_F(SweepCommand, CountsRunsWithWarningsAndFailsForThemIfStrict) {
  const std::string command = "sweep " + (folder_ / "scene.toml") +
                              " --force --policy paper --set policy.tau=0,0.5 --out " + (folder_ / "sweep");
  const Outcome outcome = talus_command(command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(", 1 with warnings"), std::string::npos) << outcome.out;
  EXPECT_EQ(talus_command(command + " --strict").exit_code, 1);
}

TEST_F(SweepCommand, EmitsAListWhoseLinesGiveTheBitsOfALocalSweep) {
  const Outcome outcome = emit();
  EXPECT_NE(outcome.out.find("4 lines, 2 tasks of 3"), std::string::npos) << outcome.out << outcome.err;
  EXPECT_EQ(std::ranges::count(file("tasks.txt"), '\n'), 4);
  EXPECT_NE(file("array.sh").find("--array=0-1 "), std::string::npos) << file("array.sh");
  EXPECT_NE(file("array.sh").find("--time=5 --comment=\"a b\"\n"), std::string::npos) << file("array.sh");
  for (const char* chunk : {"99", "2", "foo", "-1"})
    EXPECT_EQ(in_sweep(std::string("sh array.sh ") + chunk).exit_code, 2) << chunk;
  EXPECT_EQ(in_sweep("sh array.sh 0 && ! [ -e run_0003 ] && sh array.sh 1 && sh collect.sh").exit_code, 0);
  const std::string local = "sweep " + (folder_ / "scene.toml") + " --set shape.disc.friction=0.2,0.6 --seeds 2 --out ";
  ASSERT_EQ(talus_command(local + (folder_ / "local")).exit_code, 0);
  EXPECT_EQ(in_sweep("cut -d, -f1-6 sweep.csv").out, in_sweep("cut -d, -f1-6 ../local/sweep.csv").out);
}

TEST_F(SweepCommand, DoesARunOfWhichAKilledProcessLeftAHalfAgain) {
  ASSERT_EQ(emit(" --set run.pace=2").exit_code, 0);  // a second of wall time a run, so that it is seen at work
  const Outcome killed = in_sweep(R"("$TALUS" sweep --resume . --only 0
setsid "$TALUS" sweep --resume . --only 1 & until ls at_work/run_0001*/frames.csv 2>/dev/null; do :; done
kill -KILL -- -$!; flock -w 10 lock true  # until both processes have ended
"$TALUS" sweep --status .; "$TALUS" sweep --collect .)");
  EXPECT_EQ(killed.exit_code, 1);
  EXPECT_NE(killed.out.find("4 runs: 1 finished, 0 failed, 1 begun, 2 not begun"), std::string::npos) << killed.out;
  EXPECT_NE(killed.err.find("seed=2 began and has not ended"), std::string::npos) << killed.err;
  EXPECT_EQ(std::ranges::count(file("sweep.csv"), '\n'), 2);
  EXPECT_EQ(in_sweep("\"$TALUS\" sweep --resume .").exit_code, 0);
  EXPECT_EQ(std::ranges::count(file("sweep.csv"), '\n'), 5);
  EXPECT_TRUE(fs::is_empty(folder_.path() / "sweep" / "at_work"));
}

TEST_F(SweepCommand, TellsOfAFailedRunTheEndOfItsMessages) {
  ASSERT_EQ(emit().exit_code, 0);
  EXPECT_EQ(in_sweep("ulimit -f 1; \"$TALUS\" sweep --resume . --only 2").exit_code, 1);
  const Outcome outcome = in_sweep("\"$TALUS\" sweep --status .");
  EXPECT_NE(outcome.out.find("0 finished, 1 failed, 0 begun, 3 not begun"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("run_0002 shape.disc.friction=0.6 seed=1 failed: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
  EXPECT_EQ(in_sweep("\"$TALUS\" sweep --resume .").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "sweep" / "failed" / "run_0002.txt"));
}

TEST_F(SweepCommand, IsRefusedWhereAnotherIsAtWork) {
  const Outcome outcome =
      shell("slow='sweep " + (folder_ / "scene.toml") + " --set run.pace=0.01 --out " + (folder_ / "sweep") + R"('
"$TALUS" $slow & until ls )" +
            (folder_ / "sweep") + R"(/at_work/run* 2>/dev/null; do :; done
"$TALUS" $slow; code=$?; "$TALUS" sweep --resume )" +
            (folder_ / "sweep") + R"( --only 0 && code=0
kill $!; wait; exit $code)");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("another command is at work in this folder"), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, GoesOnWithNoOtherSceneThanItBegan) {
  ASSERT_EQ(emit().exit_code, 0);
  std::ofstream(folder_.path() / "scene.toml", std::ios::app) << "# more\n";
  const Outcome outcome = in_sweep("\"$TALUS\" sweep --resume . --only 0");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("must be as it was when the sweep"), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, GoesOnWithNoOtherFilesThanItsScenesWereReadFrom) {
  const fs::path folder = folder_.path();
  fs::rename(folder / "scene.toml", folder / "base.toml");
  std::ofstream(folder / "scene.toml")
      << "include = \"base.toml\"\nshape.rock = {kind = \"mesh\", file = \"rock.obj\", longest_side = 1}\n";
  std::ofstream(folder / "rock.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const Outcome begun = emit();
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  for (const char* name : {"base.toml", "rock.obj"}) {
    const std::string before = contents(folder / name);
    std::ofstream(folder / name, std::ios::app) << "# more\n";
    const Outcome outcome = in_sweep("\"$TALUS\" sweep --resume . --only 0");
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_NE(outcome.err.find(std::string(name) + ": must be as it was when the sweep"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(emit().exit_code, 2) << name;
    std::ofstream(folder / name) << before;
  }
  EXPECT_EQ(in_sweep("\"$TALUS\" sweep --resume . --only 0").exit_code, 0);
}

TEST_F(SweepCommand, TakesItsPlanFromTheFolderAlone) {
  ASSERT_EQ(emit().exit_code, 0);
  const std::string folder = folder_ / "sweep";
  for (const std::string& line :
       {"--resume " + folder + " --seeds 3", "--status " + folder + " --collect " + folder, "--out " + folder,
        "--resume " + folder + " --only 4", "--resume " + folder + " --chunk 3", "--status " + folder + " --jobs 2",
        "--collect " + folder + " --on slurm", "--status " + folder + " --sbatch=-x",
        "--resume " + folder + " --only 0 --chunk 3", "--collect " + (folder_ / "none")})
    EXPECT_EQ(talus_command("sweep " + line).exit_code, 2) << line;
}

TEST_F(SweepCommand, OnSlurmWithoutSbatchIsRefused) {
  const Outcome outcome =
      shell("PATH= \"$TALUS\" sweep " + (folder_ / "scene.toml") + " --on slurm --out " + (folder_ / "sweep"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("sbatch is not on this machine"), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, OfOtherValuesIsRefusedInTheSameFolder) {
  ASSERT_EQ(sweep().exit_code, 0);
  const Outcome outcome = sweep(" --set run.frames=30,60");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("must be new, empty, or of the same sweep"), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, WithAValueThatTheSceneRefusesEndsBeforeTheFirstRun) {
  const Outcome outcome = sweep(" --set source[0].rate=1,-1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("source[0].rate"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "sweep"));
}

TEST_F(SweepCommand, WithARangeThatIsNoneIsRefused) {
  const Outcome outcome = sweep(" --set source[0].rate=3:1:1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("LOW:HIGH:STEP"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::sweep_command_test
