// Sweeps on a Slurm of two nodes, which each test starts and stops.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "tests/process/process.h"

namespace talus::slurm_test {
namespace {

class LongSlurm : public ::testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "Slurm's daemons are started as root";
    std::ofstream(folder_.path() / "scene.toml")
        << "title = \"Ten discs\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
           "source = [{count = 10, rate = 6, position = [0, 8], velocity = [0, -7]}]\nrun = {frames = 60}\npile = "
           "[{}]\n";
    const Outcome start = shell("bash tests/slurm/cluster.sh start " + (folder_ / "slurm") + " 2");
    ASSERT_EQ(start.exit_code, 0) << start.err;
  }
  void TearDown() override { shell("bash tests/slurm/cluster.sh stop " + (folder_ / "slurm")); }

  /// In the folder, with $sweep: twelve runs of a second and a half each, a task of the array for each. `collected`
  /// waits up to two minutes for the table.
  Outcome on_cluster(const std::string& script) const {
    return shell("cluster=$PWD/tests/slurm/cluster.sh; cd " + folder_.path().string() +
                 "\nexport SLURM_CONF=$PWD/slurm/slurm.conf\n"
                 "sweep='sweep scene.toml --set shape.disc.friction=0.2,0.6 --seeds 6 --set run.pace=0.7'\n"
                 "collected() { for i in $(seq 1200); do [ -e $1/sweep.csv ] && return; sleep 0.1; done; squeue; "
                 "tail -n 50 slurm/*.log; return 1; }\n" +
                 script);
  }
  std::string hashes(const char* sweep) const { return shell("cut -d, -f1-7 " + (folder_ / sweep) + "/sweep.csv").out; }
  /// The same without Slurm.
  std::string local_hashes() const {
    EXPECT_EQ(on_cluster("\"$TALUS\" $sweep --jobs 12 --out local").exit_code, 0);
    return hashes("local");
  }

  TemporaryFolder folder_;
};

TEST_F(LongSlurm, GivesTheBitsOfALocalSweepAndReturnsAtOnce) {
  const Outcome outcome = on_cluster(R"sh(
"$TALUS" $sweep --out refused --on slurm --sbatch --partition=none; [ $? = 1 ] || exit 92
"$TALUS" $sweep --out cluster --on slurm --sbatch "--partition=all --time=5" || exit
[ ! -e cluster/sweep.csv ] || exit 90
"$TALUS" sweep --status cluster
"$TALUS" sweep --resume cluster; [ $? = 2 ] || exit 91
collected cluster; until [ "$(squeue --noheader)" = "" ]; do sleep 0.1; done
"$TALUS" sweep --status cluster)sh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("12 lines of tasks.txt in job 1, an array of 12 tasks of 1, and job 2, which collects"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.err.find("sbatch refused "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("Slurm has jobs of this folder, jobs 1,2: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("12 runs: 12 finished, 0 failed, 0 begun, 0 not begun\n"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(hashes("cluster"), local_hashes());
}

TEST_F(LongSlurm, DoesAKilledTaskAgainWhenItGoesOn) {
  const Outcome outcome = on_cluster(R"sh(
"$TALUS" $sweep --out cluster --on slurm || exit
until task=$(ls cluster/at_work | grep '^run_0001.*txt'); do sleep 0.1; done
process=${task%.txt}; process=${process##*.}
kill -KILL $process $(pgrep -P $process)
collected cluster; "$TALUS" sweep --status cluster
cp cluster/sweep.csv first.csv; rm cluster/sweep.csv; sleep 2
"$TALUS" sweep --resume cluster --on slurm || exit
collected cluster)sh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("12 runs: 11 finished, 0 failed, 1 begun, 0 not begun"), std::string::npos) << outcome.out;
  EXPECT_EQ(std::ranges::count(contents(folder_.path() / "first.csv"), '\n'), 12);
  EXPECT_NE(outcome.out.find("\n1 lines of tasks.txt in job "), std::string::npos) << outcome.out;
  EXPECT_EQ(hashes("cluster"), local_hashes());
}

TEST_F(LongSlurm, LosesNoRunWithANode) {
  const Outcome outcome = on_cluster(R"sh(
"$TALUS" $sweep --out cluster --on slurm || exit
until [ "$(squeue --noheader --states=RUNNING --nodelist=b | wc -l)" = 2 ]; do sleep 0.1; done; sleep 0.7
bash $cluster lose slurm b
collected cluster && grep -c "due to failure of node b" slurm/slurmctld.log)sh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(hashes("cluster"), local_hashes());
}

TEST_F(LongSlurm, GivesTheBitsOfALocalBenchmark) {
  const Outcome outcome = on_cluster(R"sh(
bench='bench scene.toml --policy full,adaptive --seeds 3'
"$TALUS" $bench --out here || exit
"$TALUS" $bench --out cluster --on slurm || exit
for i in $(seq 1200); do [ -e cluster/bench.csv ] && break; sleep 0.1; done
"$TALUS" bench --status cluster
hashes() { cut -d, -f1-5 $1/bench.csv; grep -o '"end_hash[^,]*' $1/rows/*.json | sed 's/.*rows//'; }
[ "$(hashes here)" = "$(hashes cluster)" ])sh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("3 lines of tasks.txt in job 1, an array of 3 tasks of 1"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("6 runs: 6 measured, 0 failed, 0 not measured"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace talus::slurm_test
