#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "common/scene/read_scene.h"
#include "common/scene/warnings.h"
#include "common/scene/write_scene.h"
#include "tests/common/scene_description.h"
#include "tests/common/temporary_folder.h"

namespace talus::scene_files_test {
namespace {

namespace fs = std::filesystem;
const fs::path scenes = fs::path(TALUS_SOURCE_DIR) / "scenes";

template <int Dim>
void expect_example_one(const Scene<Dim>& scene) {
  ASSERT_EQ(scene.sources.size(), 1u);
  EXPECT_EQ(scene.sources[0].count, 400);
  EXPECT_EQ(scene.run.frames, 2418);
  EXPECT_EQ(scene.run.until, until_rest);
  EXPECT_EQ(scene.world.dt, 1.0 / 60.0);
  EXPECT_EQ(scene.steps_per_frame(), 2);
  EXPECT_EQ(scene.steps(), 4836);
  ASSERT_EQ(scene.piles.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.piles[0].alpha.value(), std::numbers::pi / 4.0);
  EXPECT_FALSE(scene.piles[0].at.has_value());
  EXPECT_EQ(scene.policy.kind, "adaptive");
  EXPECT_EQ(scene.policy.paper.tau, 0.5);
}

TEST(DropInAPile, IsThePapersFirstExample) {
  expect_example_one(std::get<Scene<2>>(read_scene(scenes / "drop_in_a_pile_2d.toml")));
  expect_example_one(std::get<Scene<3>>(read_scene(scenes / "drop_in_a_pile_3d.toml")));
}

std::string written_and_read(const AnyScene& scene) {
  const TemporaryFolder folder;
  std::visit([&](const auto& one) { write_scene_files(scene_files(one), folder.path()); }, scene);
  return std::visit([](const auto& one) { return description(one); }, read_scene(folder / "scene.toml"));
}

// What stays so that results stay comparable: the parts of the shipped bunny, made for speed (docs/scenes.md), and the
// step of the paper's rings.
template <int Dim>
void expect_known_warnings_only(const Scene<Dim>& scene) {
  for (const std::string& line : warnings(scene)) {
    const bool of_bunny = line.find("shape.bunny: its parts have 0.893 times the mesh's volume") != std::string::npos;
    const bool of_rings =
        scene.world.shapes.front().name == "O" && line.find("times their thickness in a step") != std::string::npos;
    EXPECT_TRUE(of_bunny || of_rings) << line;
  }
}

TEST(EveryScene, IsReadWithoutNewWarningsAndWrittenBackTheSame) {
  int count = 0;
  for (const char* folder : {".", "public", "questions"})
    for (const auto& entry : fs::directory_iterator(scenes / folder)) {
      if (entry.path().extension() != ".toml") continue;
      SCOPED_TRACE(entry.path());
      for (const std::vector<Override>& overrides : {std::vector<Override>(), {{"seed=7"}, {"policy.tau=0.1"}}}) {
        const AnyScene scene = read_scene(entry.path(), overrides);
        if (folder == std::string_view("."))
          std::visit([](const auto& one) { expect_known_warnings_only(one); }, scene);
        EXPECT_EQ(written_and_read(scene), std::visit([](const auto& one) { return description(one); }, scene));
      }
      ++count;
    }
  EXPECT_GE(count, 40);
}

// A run's folder must be enough to run it again.
TEST(SceneFiles, AreAlsoTheMeshesThatTheSceneNames) {
  const std::string text =
      "title = \"A scene\"\ndimension = 3\n[shape.bunny]\nkind = \"mesh\"\nfile = \"shapes/bunny.obj\"\n[[source]]\n";
  const AnyScene scene = parse_scene(text, (scenes / "made_up.toml").string());
  const TemporaryFolder folder;
  write_scene_files(scene_files(std::get<Scene<3>>(scene)), folder.path());
  const AnyScene again = read_scene(folder / "scene.toml");
  EXPECT_EQ(description(std::get<Scene<3>>(again)), description(std::get<Scene<3>>(scene)));
}

TEST(SceneFiles, OfAnIncludedSceneLieBesideThatOne) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "stock/shapes");
  fs::copy(scenes / "shapes/bunny.obj", folder.path() / "stock/shapes/bunny.obj");
  std::ofstream(folder.path() / "stock/base.toml")
      << "dimension = 2\n[shape.bunny]\nkind = \"mesh\"\nfile = \"shapes/bunny.obj\"\n";
  std::ofstream(folder.path() / "scene.toml") << "include = \"stock/base.toml\"\ntitle = \"A\"\n[[source]]\n";
  const AnyScene scene = read_scene(folder.path() / "scene.toml");
  EXPECT_EQ(written_and_read(scene), description(std::get<Scene<2>>(scene))) << "a run's folder has it too";
}

TEST(SceneFiles, OfASceneMadeByAProgramAreNone) { EXPECT_TRUE(scene_files(Scene<2>()).empty()); }

TEST(SceneFiles, AreRegularFilesOnly) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.parts.obj").c_str(), 0600), 0);
  Scene<2> scene;
  scene.toml = "text";
  scene.folder = folder.path();
  scene.referred = {"a.parts.obj"};
  EXPECT_THROW(scene_files(scene), std::invalid_argument);
}

TEST(SceneFiles, AreWrittenBelowTheFolderOnlyAndIntoOneThatCanBe) {
  const TemporaryFolder folder;
  for (const char* name : {"../a.toml", "/a.toml", "a/../../b", "", "a/"})
    EXPECT_THROW(write_scene_files({{name, "text"}}, folder.path()), std::invalid_argument) << name;
  std::ofstream(folder / "file") << "text";
  EXPECT_ANY_THROW(write_scene_files({{"a.toml", "text"}}, folder / "file"));
}

}  // namespace
}  // namespace talus::scene_files_test
