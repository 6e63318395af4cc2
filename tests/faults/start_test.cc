// Runs that start at the same time, and folders that cannot be used.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/faults/faults.h"

namespace talus::start_fault_test {
namespace {

namespace fs = std::filesystem;

/// Starts four runs at once and waits for them. How many finished is printed.
Outcome start_four(const TemporaryFolder& folder, const std::string& options) {
  return shell_in(folder, "for i in 1 2 3 4; do \"$TALUS\" " + short_run() + options +
                              " >out$i 2>err$i & all=\"$all $!\"; done\n"
                              "for one in $all; do wait $one && finished=$((finished + 1)); done; echo $finished");
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(StartFault, FourRunsStartedAtOnceGetFourFoldersAndTheSameBits) {
  for (int trial = 0; trial < 5; ++trial) {
    const TemporaryFolder folder;
    EXPECT_EQ(start_four(folder, "").out, "4\n");
    EXPECT_EQ(entries(folder.path() / "runs"), 4U);
#ifdef TALUS_LCM
    std::set<std::string> records;
    for (const auto& run : fs::directory_iterator(folder.path() / "runs"))
      records.insert(contents(run.path() / "run.lcm"));
    EXPECT_EQ(records.size(), 1U);
#endif
  }
}

TEST(StartFault, OfFourRunsIntoOneFolderOneFinishesAndTheOthersAreRefused) {
  for (int trial = 0; trial < 5; ++trial) {
    const TemporaryFolder folder;
    EXPECT_EQ(start_four(folder, "--out race").out, "1\n");
    const Outcome messages = shell_in(folder, "cat err?");
    EXPECT_NE(messages.out.find("--out = race: must be a new or empty folder"), std::string::npos) << messages.out;
  }
}

TEST(StartFault, OfFourRunsIntoOneEmptyFolderOneFinishes) {
  for (int trial = 0; trial < 5; ++trial) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "race");
    EXPECT_EQ(start_four(folder, "--out race").out, "1\n");
  }
}

TEST(StartFault, AFolderThatCannotBeMadeIsNamedWithTheReason) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& out, const std::string& reason) {
    const Outcome outcome =
        shell_in(folder, "ln -sfn loop loop; touch file; \"$TALUS\" " + short_run() + "--out " + out);
    EXPECT_EQ(outcome.exit_code, 2) << out;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
  };
  refused("/proc/run", "--out = /proc/run: ");
  refused("file", "must be a new or empty folder");
  refused("file/run", "--out = file/run: Not a directory");
  refused("loop/run", "Too many levels of symbolic links");
  refused("$(printf 'x%.0s' {1..300})", "File name too long");
  refused("''", "--out: must not be empty");
}

TEST(StartFault, AReadOnlyFolderIsRefusedBeforeTheRun) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, mount_namespace + R"(
    mkdir ro && $in_namespace bash -c 'mount -t tmpfs -o ro none ro; cd ro && "$TALUS" )" +
                                               short_run() + R"(' ||
    (cd /proc && "$TALUS" )" + short_run() + ")");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("run folder = runs"), std::string::npos) << outcome.err;
}

TEST(StartFault, ASceneThatCannotBeReachedIsNamedWithTheReason) {
  const TemporaryFolder folder;
  for (const char* command : {"run", "check"}) {
    const std::string start = "ln -sfn loop loop; \"$TALUS\" " + std::string(command);
    const Outcome loop = shell_in(folder, start + " loop");
    EXPECT_EQ(loop.exit_code, 2);
    EXPECT_NE(loop.err.find("scene = loop: Too many levels of symbolic links"), std::string::npos) << loop.err;
    const Outcome name = shell_in(folder, start + " $(printf 'x%.0s' {1..300})");
    EXPECT_EQ(name.exit_code, 2);
    EXPECT_NE(name.err.find("File name too long"), std::string::npos) << name.err;
  }
}

}  // namespace
}  // namespace talus::start_fault_test
