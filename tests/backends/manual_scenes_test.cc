// The TOML blocks of README.md and docs/*.md as scenes, each run to its end on every engine of its dimension.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/policy/sleep_policy.h"
#include "common/scene/read_scene.h"
#include "common/scene/warnings.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::manual_scenes_test {
namespace {

namespace fs = std::filesystem;

struct Block {
  std::string place;  // file and line of its first line
  std::string toml;
};

std::vector<Block> blocks_of(const fs::path& file) {
  std::vector<Block> blocks;
  std::ifstream stream(file);
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = line == "```toml";
      if (inside) blocks.push_back({file.filename().string() + ":" + std::to_string(number + 1), ""});
    } else if (inside) {
      blocks.back().toml += line + "\n";
    }
  }
  return blocks;
}

/// All blocks as whole scenes. A fragment, which has no
/// title, is added to the manual's first scene.
std::vector<Block> manual_scenes() {
  const fs::path root = TALUS_SOURCE_DIR;
  std::vector<fs::path> files = {root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const std::string first = blocks_of(root / "docs" / "scenes.md").at(0).toml;
  std::vector<Block> scenes;
  for (const fs::path& file : files) {
    for (Block& block : blocks_of(file)) {
      if (!block.toml.starts_with("title = ")) block.toml = first + block.toml;
      scenes.push_back(std::move(block));
    }
  }
  return scenes;
}

template <typename Backend>
class ManualScenes : public ::testing::Test {};

TYPED_TEST_SUITE(ManualScenes, SmallStepsBackends, BackendName);

TYPED_TEST(ManualScenes, DropAllTheirBodiesBeforeTheirEndWithoutAWarning) {
  constexpr int dim = TypeParam::dim;
  const std::vector<Block> all = manual_scenes();
  EXPECT_GE(all.size(), 2u);
  for (const Block& block : all) {
    SCOPED_TRACE(block.place);
    const AnyScene any = parse_scene(block.toml, block.place);
    const auto* scene = std::get_if<Scene<dim>>(&any);
    if (scene == nullptr) continue;
    EXPECT_EQ(warnings(*scene), std::vector<std::string>());
    auto simulation = simulation_on<TypeParam>(*scene);
    Watcher<dim> observer;
    simulation.add_observer(observer);
    while (!simulation.finished()) simulation.step();
    for (const Warning& warning : simulation.warnings()) ADD_FAILURE() << account(warning);
    EXPECT_EQ(simulation.emitter().emitted(), simulation.emitter().total());
    EXPECT_EQ(simulation.world().states().size(), simulation.emitter().total());
  }
}

// Turned alike they stack: with no spread 11 of 60 boxes appear on Box2D, with half the default 18.
TYPED_TEST(ManualScenes, ASpoutOfBoxesTurnedAlikeMakesAPileWithTheDefaultSpread) {
  constexpr int dim = TypeParam::dim;
  const bool flat = dim == 2;
  const std::string text = fmt::format(
      "title = \"Boxes\"\ndimension = {}\nshape.box = {{kind = \"box\", size = {}}}\n[[source]]\ncount = 40\n"
      "position = {}\nvelocity = {}\nangle_deg = 0\n{}\n",
      dim, flat ? "[1, 1]" : "[1, 1, 1]", flat ? "[0, 12]" : "[0, 0, 12]", flat ? "[0, -10]" : "[0, 0, -10]",
      flat ? "" : "axis = [0, 0, 1]");
  const auto scene = std::get<Scene<dim>>(parse_scene(text, "text"));
  auto simulation = simulation_on<TypeParam>(scene);
  for (std::int64_t step = 0; step < scene.steps(); ++step) simulation.step();
  EXPECT_EQ(simulation.emitter().emitted(), 40);
}

}  // namespace
}  // namespace talus::manual_scenes_test
