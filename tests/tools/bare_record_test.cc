// A record without its folder.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/process/process.h"

namespace talus::bare_record_test {
namespace {

namespace fs = std::filesystem;

/// Runs a scene, and leaves its record alone in the folder `bare`.
class BareRecord : public testing::Test {
 protected:
  void run(const std::string& scene) {
    const Outcome outcome = talus_command("run " + scene + " --no-telemetry --out " + (folder_ / "run"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    fs::create_directory(folder_.path() / "bare");
    fs::copy_file(folder_.path() / "run" / "run.lcm", folder_.path() / "bare" / "a.lcm");
  }
  std::string bare() const { return folder_ / "bare/a.lcm"; }

  TemporaryFolder folder_;
};

TEST_F(BareRecord, IsAllThatTheCommandsOnRecordsNeed) {
  run("drop_in_a_pile_2d --set run.frames=30 --set shape.L.friction=0.3");
  for (const std::string& command :
       {std::string("info"), "film --width 320 --out " + (folder_ / "a.gif"), "replay --out " + (folder_ / "a.html"),
        "export --out " + (folder_ / "a.csv"), "compare " + (folder_ / "run")}) {
    const Outcome outcome = talus_command(command + " " + bare());
    EXPECT_EQ(outcome.exit_code, 0) << command << outcome.err;
  }
  ASSERT_EQ(talus_command("export --out " + (folder_ / "b.csv") + " " + (folder_ / "run")).exit_code, 0);
  EXPECT_TRUE(contents(folder_.path() / "a.csv") == contents(folder_.path() / "b.csv"));
  const Outcome same = talus_command("compare --twins 1 " + bare() + " " + (folder_ / "run"));
  EXPECT_NE(same.out.find("The same run, bit for bit"), std::string::npos) << same.out << same.err;
}

TEST_F(BareRecord, IsNotTheSameRunAsOneThatEndsEarlier) {
  run("drop_in_a_pile_2d --set run.frames=30");
  const std::string shorter = folder_ / "shorter";
  ASSERT_EQ(talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=20 --out " + shorter).exit_code, 0);
  const Outcome compared = talus_command("compare --twins 1 " + bare() + " " + shorter);
  EXPECT_EQ(compared.out.find("The same run"), std::string::npos) << compared.out << compared.err;
  EXPECT_NE(compared.out.find("the frames that both have are equal"), std::string::npos) << compared.out;
}

TEST_F(BareRecord, IsTakenFromTheSceneBesideItWhereItsOwnIsDamaged) {
  run("drop_in_a_pile_2d --set run.frames=30");
  std::string log = contents(bare());
  const std::size_t at = log.find("TALUS_SCENE", log.find("TALUS_SCENE") + 1);  // the first one is in TALUS_RUN
  ASSERT_NE(at, std::string::npos);
  log[at + 200] = static_cast<char>(log[at + 200] ^ 1);
  std::ofstream(bare(), std::ios::binary) << log;
  const std::string command = "replay --out " + (folder_ / "a.html") + " " + bare();
  const Outcome alone = talus_command(command);
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("no scene is in it or beside it"), std::string::npos) << alone.err;
  fs::copy_file(folder_.path() / "run" / "scene.toml", folder_.path() / "bare" / "scene.toml");
  EXPECT_EQ(talus_command(command).exit_code, 0);
}

#ifdef TALUS_BULLET
TEST_F(BareRecord, BringsTheMeshesOfItsScene) {
  run("bunny_matrices_45_3d --set run.frames=3");
  const Outcome outcome = talus_command("replay --out " + (folder_ / "a.html") + " " + bare());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}
#endif

}  // namespace
}  // namespace talus::bare_record_test

#endif
