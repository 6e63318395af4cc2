#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/scene/read_scene.h"

namespace talus::scene_bad_files_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> bad_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(TALUS_SOURCE_DIR) / "tests" / "scenes_bad"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// What the file's own first lines say: `# expect: LINE:COLUMN: ...`, the beginning of each error after the file's name.
std::vector<std::string> expected_errors(const fs::path& file) {
  const std::string mark = "# expect: ";
  std::vector<std::string> expected;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line) && line.starts_with(mark);)
    expected.push_back(file.string() + ":" + line.substr(mark.size()));
  return expected;
}

std::vector<std::string> told_errors(const fs::path& file) {
  std::vector<std::string> told;
  try {
    read_scene(file);
  } catch (const SceneErrors& errors) {
    for (const SceneError& error : errors.errors()) told.push_back(to_string(error));
  }
  return told;
}

TEST(WrongSceneFile, IsRefusedWithAllItsErrorsAndTheirPlaces) {
  const std::vector<fs::path> files = bad_files();
  EXPECT_GE(files.size(), 25u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const std::vector<std::string> expected = expected_errors(file);
    const std::vector<std::string> told = told_errors(file);
    ASSERT_FALSE(expected.empty());
    ASSERT_EQ(told.size(), expected.size());
    for (std::size_t i = 0; i < told.size(); ++i)
      EXPECT_TRUE(told[i].starts_with(expected[i])) << "told:     " << told[i] << "\nexpected: " << expected[i];
  }
}

TEST(SceneFileThatIsNotThere, IsAnErrorThatNamesIt) {
  try {
    read_scene("no/such/scene.toml");
    FAIL() << "was read";
  } catch (const SceneErrors& errors) {
    EXPECT_STREQ(errors.what(), "no/such/scene.toml: no such file, or it cannot be read");
  }
}

TEST(Folder, IsNoSceneFile) { EXPECT_THROW(read_scene(fs::path(TALUS_SOURCE_DIR)), SceneErrors); }

}  // namespace
}  // namespace talus::scene_bad_files_test
