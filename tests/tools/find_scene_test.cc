// Scene names on the command line: built-in scenes by name, other files by path.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/process/process.h"

namespace talus::find_scene_test {
namespace {

namespace fs = std::filesystem;

const std::string small_scene =
    "title = \"Made here\"\ndimension = 2\n[shape.disc]\nkind = \"ball\"\nradius = 0.5\n[[source]]\ncount = 1\n";

/// A current directory with a folder `scenes` of its own.
class LocalScenesFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "scenes");
    std::ofstream(folder_ / "scenes/made_here.toml") << small_scene;
    std::ofstream(folder_ / "scenes/drop_in_a_pile_2d.toml") << small_scene;
  }
  Outcome here(const std::string& command) const { return shell("cd " + folder_.path().string() + " && " + command); }

  TemporaryFolder folder_;
};

TEST_F(LocalScenesFolder, HidesNoBuiltInScene) {
  const Outcome checked = here("$TALUS check drop_in_a_pile_2d");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("400 bodies"), std::string::npos) << checked.out;
  const Outcome other = here("$TALUS check multiple_piles_2d");
  EXPECT_EQ(other.exit_code, 0) << other.err;
}

TEST_F(LocalScenesFolder, IsNotListed) {
  const Outcome listed = here("$TALUS list");
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_NE(listed.out.find("multiple_piles_2d"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("Made here"), std::string::npos) << listed.out;
}

TEST_F(LocalScenesFolder, HoldsScenesThatAreFoundByPathOnly) {
  EXPECT_EQ(here("$TALUS check scenes/made_here.toml").exit_code, 0);
  EXPECT_EQ(here("$TALUS check made_here").exit_code, 2);
}

TEST(InstalledCommand, FindsTheScenesThatAreInstalledBesideIt) {
  const TemporaryFolder prefix;
  fs::create_directories(prefix / "bin");
  fs::create_directories(prefix / "share/talus/scenes");
  std::ofstream(prefix / "share/talus/scenes/made_here.toml") << small_scene;
  const std::string root = prefix.path().string();
  const Outcome listed = shell("cp $TALUS " + root + "/bin/talus && cd / && " + root + "/bin/talus list");
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_NE(listed.out.find("Made here"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("multiple_piles_2d"), std::string::npos) << listed.out;
}

}  // namespace
}  // namespace talus::find_scene_test
