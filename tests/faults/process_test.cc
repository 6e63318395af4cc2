// What the system does to a run: signals, full disks, little memory, no network.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/faults/faults.h"

namespace talus::process_fault_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Starts a run that would take minutes, in the folder `run`, and waits until it records; its number is $process.
const std::string long_run_begins = R"(
env --default-signal=HUP "$TALUS" run drop_in_a_pile_2d --no-telemetry --policy full --set run.until=frames --set run.frames=100000 --out run &
process=$!
until [ -e run/frames.csv ]; do sleep 0.01; done
)";

class Signal : public ::testing::TestWithParam<const char*> {};

TEST_P(Signal, EndsARunWithItsSummary) {
  const TemporaryFolder folder;
  const Outcome outcome =
      shell_in(folder, long_run_begins + "sleep 0.2; kill -" + GetParam() + " $process; wait $process");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  const Json summary = Json::parse(contents(folder.path() / "run" / "summary.json"));
  EXPECT_EQ(summary["reason"], "interrupted");
  EXPECT_TRUE(fs::exists(folder.path() / "run" / "pile.png"));
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, Signal, ::testing::Values("INT", "TERM", "HUP"),
                         [](const auto& test) { return std::string(test.param); });

TEST(SignalFault, AnIgnoredHangUpStaysIgnored) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, "env --ignore-signal=HUP \"$TALUS\" " + short_run(2000) +
                                               "--policy full --out run & process=$!\n"
                                               "until [ -e run/frames.csv ]; do sleep 0.01; done\n"
                                               "kill -HUP $process; wait $process");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(SignalFault, AStoppedRunGoesOnToTheSameBits) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, "\"$TALUS\" " + short_run(600) + "--policy full --out a\n" + "\"$TALUS\" " +
                                               short_run(600) + R"(--policy full --out b & process=$!
until [ -e b/frames.csv ]; do sleep 0.01; done
kill -STOP $process; sleep 0.3; kill -CONT $process; wait $process && cmp a/run.lcm b/run.lcm)");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
}

#ifdef TALUS_LCM

TEST(SignalFault, AStoppedMonitorChangesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, "\"$TALUS\" " + short_run(600) + R"(--out a
export LCM_DEFAULT_URL='udpm://239.255.76.67:7691?ttl=0'
"$TALUS" monitor >heard 2>&1 & monitor=$!
sleep 0.3; kill -STOP $monitor
"$TALUS" run drop_in_a_pile_2d --set run.frames=600 --out b; code=$?
kill -CONT $monitor; sleep 0.3; kill -TERM $monitor; wait $monitor
cmp a/run.lcm b/run.lcm && exit $code)");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
}

TEST(NetworkFault, WithoutARouteForMulticastARunSaysSoAndGoesOn) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, R"(
unshare --net true 2>/dev/null && alone="unshare --net"
[ -n "$alone" ] || { unshare --user --map-root-user --net true 2>/dev/null && alone="unshare --user --map-root-user --net"; }
unset LCM_DEFAULT_URL
$alone "$TALUS" run drop_in_a_pile_2d --set run.frames=40 --hash --out a; echo "$alone")");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find('\n'), 16U) << "nothing but the hash belongs on standard output: " << outcome.out;
  if (outcome.out.size() > 18U) EXPECT_NE(outcome.err.find("no live view"), std::string::npos) << outcome.err;
}

/// Kills a run `kills` times, each at a random moment of its first seconds, and reads what is left.
void kill_at_random_moments(int kills) {
  for (int trial = 0; trial < kills; ++trial) {
    const TemporaryFolder folder;
    const Outcome outcome = shell_in(folder, "RANDOM=" + std::to_string(trial) + long_run_begins + R"(
sleep $((RANDOM % 3)).$((RANDOM % 900 + 100))
kill -KILL $process; killed=$(date +%s%N); wait $process
echo $(((killed - $(date -r run/run.lcm +%s%N)) / 1000000)) $(stat -c %s run/run.lcm)
"$TALUS" compare run run --json >comparison; echo $?)");
    std::istringstream words(outcome.out);
    int milliseconds = 0;
    int bytes = 0;
    int read = -1;
    words >> milliseconds >> bytes >> read;
    EXPECT_LE(milliseconds, 2000) << "a second, and one for a busy machine";
    EXPECT_TRUE(read == 0 || (read == 2 && bytes < 4096)) << read << ": " << outcome.err;
    if (read == 0 && bytes > 0)
      EXPECT_LT(Json::parse(contents(folder.path() / "comparison"))["a"]["damaged_bytes"], 60000);
  }
}

TEST(SignalFault, AKilledRunLeavesARecordThatLacksASecondAtMost) { kill_at_random_moments(2); }

TEST(LongSignalFault, ARunKilledAtFiftyMomentsLeavesARecordThatLacksASecondAtMost) { kill_at_random_moments(50); }

#endif

/// Runs in a file system of that size, or where mounting is forbidden with files of at most that size.
void run_on_full_disk(int kilobytes) {
  const TemporaryFolder folder;
  const std::string size = std::to_string(kilobytes);
  const Outcome outcome = shell_in(folder, mount_namespace + "size=" + size + R"(
cat >script <<'END'
"$TALUS" )" + short_run(150) + R"(--out run; code=$?
"$TALUS" compare run run >/dev/null 2>comparison; [ $? -lt 128 ] || { echo "compare died"; cat comparison; }
wc -l <run/frames.csv
exit $code
END
mkdir small
if [ "$in_namespace" = false ]; then cd small; ulimit -f $size; . ../script
else $in_namespace bash -c "mount -t tmpfs -o size=${size}k none small && cd small && . ../script"; fi)");
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << size << ": " << outcome.exit_code << outcome.err;
  EXPECT_EQ(outcome.out.find("died"), std::string::npos) << size << ": " << outcome.out;
  if (outcome.exit_code == 0)
    EXPECT_NE(outcome.out.find("301\n"), std::string::npos) << size << ": frames.csv is cut and nothing says so";
  else
    EXPECT_NE(outcome.err.find("talus: "), std::string::npos) << size << ": " << outcome.err;
}

TEST(DiskFault, AFullDiskEndsARunWithAMessage) {
  for (const int kilobytes : {8, 64, 256}) run_on_full_disk(kilobytes);
}

TEST(LongDiskFault, AFullDiskOfFourteenSizesEndsARunWithAMessageOrIsLargeEnough) {
  for (const int kilobytes : {4, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 4096}) run_on_full_disk(kilobytes);
}

TEST(DiskFault, AFileThatMayNotGrowEndsARunWithAMessage) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, "ulimit -f 16; \"$TALUS\" " + short_run(150) + "--out run");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
}

/// One frame a second leaves frames.csv the largest file. Where the disk is full at its last bytes only the last flush
/// fails.
TEST(DiskFault, FramesThatCannotBeWrittenEndARunWithAMessage) {
  const TemporaryFolder folder;
  const std::string run = R"("$TALUS" run drop_in_a_pile_2d --no-telemetry --set source[0].count=1 \
  --set run.frame_rate=1 --set run.frames=20 --set run.until=frames --out )";
  const Outcome outcome = shell_in(folder,
                                   run + R"(whole >/dev/null && kilobytes=$(($(stat -c %s whole/frames.csv) / 1024))
for limit in 64 $kilobytes; do
  (ulimit -f $limit; )" + run + R"(cut$limit; echo "exit $?")
done)");
  EXPECT_EQ(outcome.out, "exit 1\nexit 1\n");
  EXPECT_EQ(outcome.err.find("frames.csv: File too large"), outcome.err.find("frames.csv")) << outcome.err;
  EXPECT_NE(outcome.err.find("frames.csv"), outcome.err.rfind("frames.csv")) << "twice: " << outcome.err;
}

/// In the place of a picture is a folder, as if the disk took no more.
TEST(DiskFault, APictureThatCannotBeWrittenCostsNoNumbers) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, long_run_begins + "mkdir run/pile.png; kill -INT $process; wait $process");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("pile.png"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("end hash"), std::string::npos) << outcome.out;
  EXPECT_EQ(Json::parse(contents(folder.path() / "run" / "summary.json"))["reason"], "interrupted");
}

class MemoryFault : public ::testing::TestWithParam<const char*> {};

/// Drops a grid of 3000 bodies at once in address spaces from the least in which the program starts to 38 MB above.
TEST_P(MemoryFault, EndsARunWithAMessageAtAnyLimit) {
  const TemporaryFolder folder;
  const bool in_space = GetParam() == std::string("bullet");
  const std::string scene = in_space ? "scene=drop_in_a_pile_3d grid='[30, 10, 10]' spacing='[3.0, 3.0, 3.0]'"
                                     : "scene=drop_in_a_pile_2d grid='[100, 30]' spacing='[3.0, 3.0]'";
  const Outcome outcome = shell_in(folder, scene + " backend=" + GetParam() + R"(
least=20000
until (ulimit -v $least; "$TALUS" --version >/dev/null 2>&1) || [ $least -gt 100000 ]; do least=$((least + 1000)); done
for limit in $(seq $least 1900 $((least + 38000))); do
  message=$(ulimit -c 0; ulimit -v $limit
    "$TALUS" run $scene --backend $backend --hash --policy adaptive --set run.frames=5 --set source[0].rate=1e6       --set source[0].count=3000 --set "source[0].grid=$grid" --set "source[0].spacing=$spacing" 2>&1 >/dev/null)
  echo "$? $message"
done | sort | uniq)");
  std::istringstream lines(outcome.out);
  int endings = 0;
  for (std::string line; std::getline(lines, line); ++endings)
    EXPECT_TRUE(line == "0 " || line == "1 talus: out of memory" || line.starts_with("2 talus: source")) << line;
  EXPECT_GE(endings, 2) << "no limit was too low, or all were: " << outcome.out << outcome.err;
}

std::vector<const char*> backends() {
#ifdef TALUS_BULLET
  return {"box2d", "bullet-planar", "bullet"};
#else
  return {"box2d"};
#endif
}

INSTANTIATE_TEST_SUITE_P(OnEachBackend, MemoryFault, ::testing::ValuesIn(backends()), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace talus::process_fault_test
