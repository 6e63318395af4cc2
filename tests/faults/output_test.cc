// Standard output and standard error that are closed or full.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/faults/faults.h"

namespace talus::output_fault_test {
namespace {

namespace fs = std::filesystem;

/// A folder with a recorded run in `run` and a mesh in `mesh.obj`.
class OutputFault : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome outcome = shell_in(folder_, R"("$TALUS" )" + short_run() + R"(--out run
cat >mesh.obj <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
END)");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// One command line of each sub-command that ends within a second.
  static std::vector<std::string> commands() {
    std::vector<std::string> list = {"--help",
                                     "--version",
                                     "list",
                                     "check drop_in_a_pile_2d",
                                     short_run() + "--hash",
                                     short_run() + "--out new",
                                     "bench --help"};
#ifdef TALUS_BULLET
    list.emplace_back("decompose mesh.obj");
#endif
#ifdef TALUS_LCM
    list.emplace_back("compare run run");
    list.emplace_back("info run");
    list.emplace_back("info --messages run");
#endif
    return list;
  }

  Outcome with(const std::string& command, const std::string& redirection) const {
    return shell_in(folder_, "rm -rf new; \"$TALUS\" " + command + " " + redirection);
  }

  const TemporaryFolder folder_;
};

TEST_F(OutputFault, AResultThatCannotBePrintedIsAnErrorOfEverySubCommand) {
  for (const std::string& command : commands()) {
    for (const char* redirection : {">/dev/full", ">&-"}) {
      const Outcome outcome = with(command, redirection);
      EXPECT_EQ(outcome.exit_code, 1) << command << redirection;
      EXPECT_NE(outcome.err.find("talus: standard output: "), std::string::npos) << command << ": " << outcome.err;
    }
  }
}

TEST_F(OutputFault, AMessageThatCannotBePrintedChangesNothing) {
  for (const std::string& command : commands())
    for (const char* redirection : {"2>/dev/full", "2>&-"})
      EXPECT_EQ(with(command, redirection).exit_code, 0) << command;
  for (const char* redirection : {"2>/dev/full", "2>&-", "2>&- >&-", "2>/dev/full >/dev/full", "<&- >&- 2>&-"}) {
    EXPECT_EQ(with("check nonexistent", redirection).exit_code, 2) << redirection;
    EXPECT_EQ(with("run --no-such-option", redirection).exit_code, 2) << redirection;
    EXPECT_EQ(with("run drop_in_a_pile_2d --set run.frames=-1", redirection).exit_code, 2) << redirection;
  }
}

TEST_F(OutputFault, ARunLeavesTheSameRecordWithAllStreamsClosed) {
  EXPECT_EQ(with(short_run() + "--set source[0].rate=60 --out warned", "2>/dev/full").exit_code, 0);
  EXPECT_EQ(with(short_run() + "--out closed", "<&- >&- 2>&-").exit_code, 1);
  for (const char* file : {"scene.toml", "frames.csv", "summary.json", "pile.png", "pile.svg"}) {
    EXPECT_TRUE(fs::exists(folder_.path() / "closed" / file)) << file;
    EXPECT_TRUE(fs::exists(folder_.path() / "warned" / file)) << file;
  }
#ifdef TALUS_LCM
  EXPECT_EQ(contents(folder_.path() / "closed" / "run.lcm"), contents(folder_.path() / "run" / "run.lcm"));
#endif
}

TEST_F(OutputFault, ARunGoesOnWhenTheReaderOfItsMessagesLeaves) {
  const Outcome outcome = with(short_run() + "--set source[0].rate=60 --out new", "2> >(head -c 1 >/dev/null)");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_.path() / "new" / "summary.json"));
}

TEST_F(OutputFault, ControlCharactersInAMessageAreShownAndNotObeyed) {
  const Outcome outcome = with("check $'\\e[31mred'", "");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("?[31mred"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::output_fault_test
