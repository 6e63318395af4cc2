// `talus view` without a browser. What its page shows and what its server lets in is tested in tests/browser.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include <fstream>
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
  refused("drop_in_a_pile_2d --pace 0.001", "--pace");
  refused("drop_in_a_pile_2d --history 0", "--history");
  refused("drop_in_a_pile_2d --listen 192.0.2.1", "--listen = 192.0.2.1: must be the IPv4 address of an interface");
  refused("drop_in_a_pile_2d --port 70000", "--port");
  refused("drop_in_a_pile_2d drop_in_a_pile_3d", "must be two run folders");
  refused("drop_in_a_pile_2d --against sleepy", "policy.kind");
  refused("drop_in_a_pile_2d --accuracy rough", "--accuracy rough: accuracy");
  refused(folder.path().string() + " --against full", "--against: must be of a scene");
  refused("drop_in_a_pile_2d --lcm-url udpm://239.255.76.67:7667",
          "--lcm-url: must be of --live; drop_in_a_pile_2d is a scene");
  refused(folder.path().string(), "must be a folder that `talus run` left");
}

TEST(ViewCommand, WarnsOfTheSceneAsARunDoes) {
  const TemporaryFolder folder;
  const std::string scene = folder / "boards.toml";
  std::ofstream(scene) << "title = \"Boards\"\ndimension = 2\n"
                          "shape.board = {kind = \"box\", size = [0.1, 1]}\nrun.frames = 1\n"
                          "[[source]]\ncount = 3\nrate = 50\nposition = [0, 5]\n";
  const std::string run = talus_command("run " + scene + " --no-telemetry --out " + (folder / "run")).err;
  const std::string view = talus_command("view " + scene + " --seconds 0.1").err;
  ASSERT_NE(run.find("warning: source[0]"), std::string::npos) << run;
  EXPECT_EQ(view.substr(0, view.find("Open this address")), run);
}

// Each would change nothing of what is shown.
TEST(ViewCommand, RefusesOptionsThatDoNotApplyToWhatIsShown) {
  const TemporaryFolder folder;
  const std::string run = folder / "run";
  ASSERT_EQ(talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=5 --out " + run).exit_code, 0);
  for (const std::string& shown : {run, run + " " + run, std::string("--live")})
    for (const char* each : {"--policy full", "--set world.gravity=5", "--seed 3", "--backend box2d", "--force",
                             "--pace 2", "--against full", "--accuracy fast"}) {
      const std::string option = each;
      const Outcome outcome = talus_command("view " + shown + " " + option);
      EXPECT_EQ(outcome.exit_code, 2) << shown << " " << option;
      const std::string rule = option.substr(0, option.find(' ')) + ": must be of a scene; ";
      EXPECT_NE(outcome.err.find(rule), std::string::npos) << outcome.err;
    }
  const Outcome history = talus_command("view " + run + " --history 16");
  EXPECT_EQ(history.exit_code, 2);
  EXPECT_NE(history.err.find("--history: must be of a scene or of --live"), std::string::npos) << history.err;
  const Outcome url = talus_command("view " + run + " --lcm-url udpm://239.255.76.67:7667");
  EXPECT_EQ(url.exit_code, 2);
  EXPECT_NE(url.err.find("--lcm-url: must be of --live; "), std::string::npos) << url.err;
}

#ifdef TALUS_BULLET
TEST(ViewCommand, ShowsNoRunInThePlaneBesideOneInSpace) {
  const TemporaryFolder folder;
  for (const char* each : {"2d", "3d"}) {
    const std::string dimension = each;
    ASSERT_EQ(talus_command("run drop_in_a_pile_" + dimension + " --no-telemetry --set run.frames=5 --out " +
                            (folder / dimension))
                  .exit_code,
              0);
  }
  const Outcome outcome = talus_command("view " + (folder / "2d") + " " + (folder / "3d"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("must be of one dimension"), std::string::npos) << outcome.err;
}
#endif

// The script gives the command a terminal, and a desktop whose browser writes down what it is to open.
TEST(ViewCommand, OpensTheBrowserOfADesktopOnceAndTellsNoOtherUserTheAddress) {
  const TemporaryFolder folder;
  const auto opened = [&](const std::string& variables, const std::string& options) {
    const Outcome outcome =
        shell("cd '" + folder.path().string() +
              "'\nrm -f opened page\nmkdir -p bin tmp\n"
              "printf '#!/bin/sh\\nsleep 0.2; stat -c \"%%a\" \"$1\" >>opened; cat \"$1\" >>page\\n' >bin/xdg-open\n"
              "chmod +x bin/xdg-open\nunset DISPLAY WAYLAND_DISPLAY XDG_RUNTIME_DIR\n"
              "export TMPDIR=$PWD/tmp PATH=$PWD/bin:$PATH " +
              variables + "\nscript -qec \"$TALUS view drop_in_a_pile_2d --seconds 1 " + options +
              "\" /dev/null\n cat opened page; ls tmp");
    return outcome.out;
  };
  const std::string desktop = opened("DISPLAY=:99", "");
  std::smatch address;
  ASSERT_TRUE(std::regex_search(desktop, address, std::regex("http://127[^\\s]+token=[0-9a-f]{32}"))) << desktop;
  EXPECT_NE(desktop.find("600\n"), std::string::npos) << "only this user reads the file\n" << desktop;
  EXPECT_NE(desktop.find("url=" + address.str() + "\""), std::string::npos) << desktop;
  EXPECT_EQ(desktop.find("talus-view-"), std::string::npos) << "the file is gone\n" << desktop;
  EXPECT_NE(opened("WAYLAND_DISPLAY=wayland-0", "").find("600\n"), std::string::npos);
  EXPECT_EQ(opened("DISPLAY=:99", "--no-open").find("600\n"), std::string::npos);
  EXPECT_EQ(opened("DISPLAY=", "").find("600\n"), std::string::npos);
}

TEST(ViewCommand, SaysThatAPortIsTaken) {
  const TemporaryFolder folder;
  const Outcome outcome =
      shell("cd '" + folder.path().string() +
            "'\n"
            "\"$TALUS\" view drop_in_a_pile_2d --seconds 60 > address &\n"  // killed below

            "for i in $(seq 50); do grep -q token address && break; sleep 0.1; done\n"
            "port=$(sed 's/.*:\\([0-9]*\\).*/\\1/' address)\n"
            "\"$TALUS\" view drop_in_a_pile_2d --seconds 1 --port $port; code=$?\nkill $!; wait; exit $code");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("cannot be listened on"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::view_command_test

#endif
