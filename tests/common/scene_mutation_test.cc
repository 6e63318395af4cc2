#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/scene/read_scene.h"
#include "tests/common/scene_description.h"

namespace talus::scene_mutation_test {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream stream(std::filesystem::path(TALUS_SOURCE_DIR) / file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Pieces that bring a mutation beyond single letters: structure, kinds and numbers at the edges.
const std::vector<std::string> pieces = {"[",
                                         "]",
                                         "[[",
                                         "]]",
                                         "{",
                                         "}",
                                         "=",
                                         "\"",
                                         "\n",
                                         "#",
                                         ".",
                                         ",",
                                         "nan",
                                         "inf",
                                         "-inf",
                                         "0",
                                         "-1",
                                         "1e308",
                                         "-0.0",
                                         "9223372036854775807",
                                         "true",
                                         "\\u",
                                         "'''",
                                         "1e-308",
                                         "1979-05-27",
                                         "\xff",
                                         "\xc3\xa4",
                                         std::string(1, 0),
                                         "3.0",
                                         "\"hull\"",
                                         "kind = \"container\"\n",
                                         "[[obstacle]]\n",
                                         "[shape.x]\n",
                                         "corners = [[0, 0], [1, 0], [0, 1]]\n",
                                         "dimension = 3\n"};

std::string mutated(std::string text) {
  const int changes = *rc::gen::inRange(1, 6);
  for (int i = 0; i < changes; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size() + 1);
    const auto length = *rc::gen::inRange<std::size_t>(0, 12);
    const int way = *rc::gen::inRange(0, 4);
    if (way == 0) {
      text.erase(at, length);
    } else if (way == 1) {
      text.insert(at, *rc::gen::elementOf(pieces));
    } else if (way == 2) {
      text.replace(at, length, *rc::gen::elementOf(pieces));
    } else {
      const auto to = *rc::gen::inRange<std::size_t>(0, text.size() + 1);
      text.insert(to, text.substr(at, length * 4));
    }
  }
  return text;
}

// Whatever the file: a scene that is written back the same, or errors with a rule each. Any other exception, and
// anything that a sanitizer finds, fails.
void expect_scene_or_errors(const std::string& text, const std::vector<Override>& overrides) {
  try {
    const AnyScene scene = parse_scene(text, "text", overrides);
    const auto same = [](const auto& one) { return description(one); };
    const auto toml = [](const auto& one) { return one.toml; };
    const AnyScene again = parse_scene(std::visit(toml, scene), "text");
    RC_ASSERT(std::visit(same, again) == std::visit(same, scene));
  } catch (const SceneErrors& errors) {
    RC_ASSERT(!errors.errors().empty());
    for (const SceneError& error : errors.errors()) {
      RC_ASSERT(!error.rule.empty());
      RC_ASSERT(!error.file.empty());
    }
  }
}

RC_GTEST_PROP(MutatedScene, IsASceneOrSceneErrors, ()) {
  const std::string file = *rc::gen::element<std::string>(
      "scenes/drop_in_a_pile_2d.toml", "scenes/drop_in_a_pile_3d.toml", "tests/scenes_bad/obstacle_wrong.toml",
      "tests/scenes_bad/pile_boundary.toml", "tests/scenes_bad/polygon_of_nine_corners.toml",
      "tests/scenes_bad/hull_flat.toml");
  const std::string text = text_of(file);
  RC_ASSERT(!text.empty());
  for (int i = 0; i < 20; ++i) expect_scene_or_errors(mutated(text), {});
}

RC_GTEST_PROP(MutatedOverride, IsASceneOrSceneErrors, ()) {
  const std::string text = text_of("scenes/drop_in_a_pile_2d.toml");
  const std::string good =
      *rc::gen::element<std::string>("policy.tau=0.4", "source[0].rate=3", "pile[0].alpha_deg=30", "run={frames=10}",
                                     "shape.x.kind=ball", "source[0].position=[0, 20]", "title=\"A title\"");
  expect_scene_or_errors(text, {{mutated(good)}, {mutated(good)}});
}

}  // namespace
}  // namespace talus::scene_mutation_test
