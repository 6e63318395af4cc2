// Whatever number is given for one field of a scene: it is refused, or the scene runs on every engine.

#include <fmt/format.h>
#include <toml++/toml.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/scene/read_scene.h"
#include "common/scene/toml_text.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/world/world.h"
#include "tests/backends/backend.h"

namespace talus::door_test {
namespace {

/// Calls `visit` with each number below a node and its path, as `source[0].position[1]`.
void for_each_number(toml::node& node, const std::string& path,
                     const std::function<void(toml::node&, const std::string&)>& visit) {
  if (node.is_integer() || node.is_floating_point())
    visit(node, path);
  else if (toml::table* table = node.as_table())
    for (auto&& [key, child] : *table)
      for_each_number(child, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()), visit);
  else if (toml::array* array = node.as_array())
    for (std::size_t i = 0; i < array->size(); ++i) for_each_number((*array)[i], fmt::format("{}[{}]", path, i), visit);
}

/// A key without the numbers of its tables: `source[0].position[1]` becomes `source[].position`.
std::string generic(const std::string& path) {
  std::string key;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '[') {
      i = path.find(']', i);
      if (i + 1 < path.size() && path[i + 1] == '.') key += "[]";
    } else {
      key += path[i];
    }
  }
  if (key.starts_with("shape.")) key = "shape.*" + key.substr(key.find('.', 6));
  return key;
}

/// The text of a scene with the defaults of all keys, and the paths of the numbers to try.
struct FullScene {
  std::string text;
  std::set<std::string> paths;
};

/// Tried are the numbers that the text gives, and one of each key that it leaves at its default.
FullScene full_scene(const std::string& text) {
  FullScene full{with_every_default(text, "text"), {}};
  std::set<std::string> keys;
  toml::table given = toml::parse(text);
  for_each_number(given, "", [&](toml::node&, const std::string& path) {
    full.paths.insert(path);
    keys.insert(generic(path));
  });
  toml::table filled = toml::parse(full.text);
  for_each_number(filled, "", [&](toml::node&, const std::string& path) {
    const std::string key = generic(path);
    if (keys.contains(key)) return;
    full.paths.insert(path);
    if (!path.ends_with("]")) keys.insert(key);
  });
  return full;
}

/// Scenes that have every numeric key together.
template <int Dim>
std::vector<FullScene> full_scenes() {
  std::vector<FullScene> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(TALUS_SOURCE_DIR "/tests/scenes_full")) {
    if (!entry.path().string().ends_with(fmt::format("_{}d.toml", Dim))) continue;
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    FullScene scene = full_scene(text);
    // Round walls are many hulls: only the numbers that the file gives are tried, to save time.
    if (!entry.path().filename().string().starts_with("every_number")) scene.text = text;
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

/// What is put in the place of each number.
struct Values {
  std::vector<double> decimals;
  std::vector<std::int64_t> wholes;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();

const Values extremes = {.decimals = {0.0, -0.0, 1e-308, 1e-45, 1e-30, 1e30, 1e308, -1.0, infinity, std::nan("")},
                         .wholes = {0, -1, 2147483648, largest}};

/// Ends of ranges and what lies between.
const Values many = {.decimals = {1e-20, 1e-10, 1e-6, 1e-3, 0.01, 0.05, 0.99, 1.0,   10.0, 89.0,     100.0,
                                  1e3,   1e4,   1e5,  1e6,  1e9,  1e38, 1e39, -1e-3, -1e4, -infinity},
                     .wholes = {1, 2, 3, 64, 1000, 10'000'000, 2147483647, std::int64_t{1} << 53, -largest}};

/// A scene's text with each number replaced by each of the values in turn.
void for_each_mutant(const FullScene& full, const Values& values,
                     const std::function<void(const std::string& change, const std::string& text)>& visit) {
  toml::table scene = toml::parse(full.text);
  const auto try_all = [&](auto& number, const auto& replacements, const std::string& path) {
    const auto before = number.get();
    for (const auto value : replacements) {
      number = value;
      visit(fmt::format("{} = {}", path, value), document_text(scene));
    }
    number = before;
  };
  for_each_number(scene, "", [&](toml::node& node, const std::string& path) {
    if (!full.paths.contains(path)) return;
    if (auto* decimal = node.as_floating_point())
      try_all(*decimal, values.decimals, path);
    else if (path != "dimension")
      try_all(*node.as_integer(), values.wholes, path);
  });
}

/// Three steps on the engine; what is wrong with them, or nothing. An engine may refuse the scene's world, which
/// `talus check` builds too.
template <typename Backend>
std::string fault_of(Scene<Backend::dim> scene, const std::string& policy) {
  scene.policy.kind = policy;
  std::unique_ptr<World<Backend::dim>> world;
  try {
    world = Backend::make(scene.world);
  } catch (const std::invalid_argument& refusal) {
    return std::string_view(refusal.what()).find(": must ") == std::string_view::npos ? refusal.what() : "";
  }
  try {
    Simulation<Backend::dim> simulation(scene, std::move(world), make_policy(scene));
    for (int step = 0; step < 3; ++step) simulation.step();
    if (scene.sources[0].start == 0.0 && simulation.world().states().size() == 0) return "dropped nothing";
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// The same of a scene file, which may be refused with a place and a rule.
template <typename Backend>
std::string fault_of(const std::string& text, const std::string& policy) {
  try {
    return fault_of<Backend>(std::get<Scene<Backend::dim>>(parse_scene(text, "text")), policy);
  } catch (const SceneErrors& errors) {
    for (const SceneError& error : errors.errors())
      if (error.rule.empty() || error.line == 0) return "refused without a place: " + to_string(error);
    return "";
  }
}

template <typename Backend>
void try_each_number(const Values& values) {
  constexpr double longest = 2.0;  // [s] of processor time
  for (const FullScene& scene : full_scenes<Backend::dim>()) {
    for_each_mutant(scene, values, [&](const std::string& change, const std::string& text) {
      const bool of_paper = change.starts_with("policy.") && !change.starts_with("policy.adaptive");
      const std::clock_t start = std::clock();
      EXPECT_EQ(fault_of<Backend>(text, of_paper ? "paper" : "adaptive"), "") << change;
      EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, longest) << change;
    });
  }
}

template <typename Backend>
class Door : public ::testing::Test {};
TYPED_TEST_SUITE(Door, SmallStepsBackends, BackendName);

template <typename Backend>
class LongDoor : public ::testing::Test {};
TYPED_TEST_SUITE(LongDoor, SmallStepsBackends, BackendName);

TYPED_TEST(Door, LetsInNoExtremeNumberThatTheEngineCannotRun) { try_each_number<TypeParam>(extremes); }

TYPED_TEST(LongDoor, LetsInNoNumberThatTheEngineCannotRun) { try_each_number<TypeParam>(many); }

TYPED_TEST(Door, IsTriedWithEveryNumberThatTheReaderLooksFor) {
  const std::set<std::string> no_numbers = {
      "count_flying", "kind",  "control_slope", "present",  "floor", "shape",  "title", "fixed",
      "asleep",       "until", "include",       "accuracy", "name",  "colour", "on",    "contacts"};
  const std::set<std::string> tables = {"world",
                                        "world.solver",
                                        "ground",
                                        "policy",
                                        "policy.adaptive",
                                        "run",
                                        "source",
                                        "obstacle",
                                        "pile",
                                        "pile[].boundary",
                                        "body",
                                        "obstacle[].motion",
                                        "event",
                                        "gate",
                                        "region",
                                        "load",
                                        "source[].scale",
                                        "world.gravity_motion"};
  // A scene has either this or world.gravity_motion.gravity, and the latter is tried.
  std::set<std::string> tried = {"world.gravity_motion.angles_deg"};
  std::set<std::string> known;
  for (const FullScene& full : full_scenes<TypeParam::dim>()) {
    toml::table scene = toml::parse(full.text);
    for_each_number(scene, "", [&](toml::node&, const std::string& path) {
      if (full.paths.contains(path)) tried.insert(generic(path));
    });
    known.merge(keys_looked_for(full.text));
  }
  EXPECT_GT(tried.size(), 60U);
  for (const std::string& key : known) {
    const std::string name = key.substr(key.rfind('.') + 1);
    if (tables.contains(key) || no_numbers.contains(name)) continue;
    EXPECT_TRUE(tried.contains(key)) << key;
  }
}

}  // namespace
}  // namespace talus::door_test
