// `talus view` without a browser. What its page shows and what its server lets in is tested in tests/browser.

#include <gtest/gtest.h>

#include <regex>

#include "tests/process/process.h"

namespace talus::view_command_test {
namespace {

TEST(ViewCommand, PrintsAnAddressOfThisMachineWithANewTokenEachTime) {
  const Outcome first = talus_command("view drop_in_a_pile_2d --seconds 0.1");
  const Outcome second = talus_command("view drop_in_a_pile_2d --seconds 0.1");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  const std::regex address("http://127\\.0\\.0\\.1:[0-9]+/\\?token=([0-9a-f]{32})\n");
  std::smatch a;
  std::smatch b;
  ASSERT_TRUE(std::regex_match(first.out, a, address)) << first.out;
  ASSERT_TRUE(std::regex_match(second.out, b, address)) << second.out;
  EXPECT_NE(a[1].str(), b[1].str());
}

TEST(ViewCommand, EndsInGoodOrderOnCtrlC) {
  const TemporaryFolder folder;
  const Outcome outcome = shell("cd '" + folder.path().string() +
                                "'\n"
                                "\"$TALUS\" view drop_in_a_pile_2d > address & process=$!\n"
                                "for i in $(seq 100); do grep -q token address && break; sleep 0.1; done\n"
                                "kill -INT $process; wait $process");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(ViewCommand, RefusesBadInput) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = talus_command("view " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("drop_in_a_pile_4d", "must be a file or the name of a scene");
  refused("drop_in_a_pile_2d --policy sleepy", "policy.kind");
  refused("drop_in_a_pile_2d --backend bullet4d", "--backend = bullet4d");
  refused("drop_in_a_pile_2d --pace nan", "--pace");
  refused("drop_in_a_pile_2d --port 70000", "--port");
  refused("drop_in_a_pile_2d drop_in_a_pile_3d", "must be two run folders");
  refused("drop_in_a_pile_2d --against sleepy", "policy.kind");
#ifdef TALUS_LCM
  refused(folder.path().string() + " --against full", "--against: must be of a scene");
  refused(folder.path().string(), "must be a folder that `talus run` left");
#endif
}

TEST(ViewCommand, SaysThatAPortIsTaken) {
  const TemporaryFolder folder;
  const Outcome outcome =
      shell("cd '" + folder.path().string() +
            "'\n"
            "\"$TALUS\" view drop_in_a_pile_2d --seconds 3 > address &\n"
            "for i in $(seq 50); do grep -q token address && break; sleep 0.1; done\n"
            "port=$(sed 's/.*:\\([0-9]*\\).*/\\1/' address)\n"
            "\"$TALUS\" view drop_in_a_pile_2d --seconds 1 --port $port; code=$?\nkill $!; wait; exit $code");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("cannot be listened on"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::view_command_test
