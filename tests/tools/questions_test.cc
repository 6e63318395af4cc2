// The scenes of lab/results/questions.md: short, and each with an answer on each engine.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/process/process.h"

#ifdef TALUS_BULLET  // the page is of all engines

namespace talus::questions_test {
namespace {

namespace fs = std::filesystem;

const fs::path scenes = fs::path(TALUS_SOURCE) / "scenes" / "questions";

/// A question's answer, a number of summary.json, and between what it must lie.
struct Question {
  const char* scene;
  const char* key;
  double least;
  double most;
  const char* setting = "seed=1";
};

// By Janssen's law with K from 0.5 to 1.5 and friction from 0.3 to 0.5 the floor of the silo carries 200 to 950 kN. The
// gripper holds up to 1,000 kg. The belt brings the boxes as they come, the fall gives 9.81 m/s, and the block stands.
// Bodies that have come to rest are packed by 0.4 to 0.7, and heaps of friction 0.6 are no steeper than 45 degrees.
constexpr Question questions[] = {
    {"floor_load_2d", "/loads/0/at_end/force_N/1", -9.5e5, -2e5},
    {"gripper_2d", "/regions/0/bodies", 1, 1, "shape.box.density=950"},
    {"gripper_2d", "/regions/0/bodies", 0, 0, "shape.box.density=1050"},
    {"packing_3d", "/regions/0/packing", 0.4, 0.7},
    {"slope_2d", "/regions/0/slope_deg", 10, 45},
    {"jam_2d", "/gates/0/net", 10, 190},
    {"belt_3d", "/gates/0/rate_per_s", 1.9, 2.1},
    {"added_gate_2d", "/gates/0/net", 20, 32},
    {"coins_3d", "/regions/0/packing", 0.4, 0.7},
    {"heavy_3d", "/regions/0/bodies", 1, 1},
    {"flow_2d", "/regions/0/mean_speed_m_per_s", 1.0, 15.0},
    {"sizes_3d", "/regions/0/mean_speed_m_per_s", 9.80, 9.82},
};

TEST(Questions, HaveScenesOfAtMost25LinesAndThePageNamesThem) {
  const std::string page = contents(fs::path(TALUS_SOURCE) / "lab" / "results" / "questions.md");
  for (const auto& entry : fs::directory_iterator(scenes)) {
    const std::string name = entry.path().stem().string();
    EXPECT_LE(std::ranges::count(contents(entry.path()), '\n'), 25) << name;
    const auto question = std::ranges::find(questions, name, &Question::scene);
    ASSERT_NE(question, std::ranges::end(questions)) << name;
    EXPECT_NE(page.find("| [" + name + "](../../scenes/questions/" + name + ".toml) | `" + question->key + "` |"),
              std::string::npos)
        << name;
  }
}

TEST(Questions, AreAnsweredOnEachEngine) {
  const TemporaryFolder folder;
  for (const auto& [scene, key, least, most, setting] : questions) {
    const bool plane = std::string(scene).ends_with("2d");
    for (const std::string& engine :
         plane ? std::vector<std::string>{"box2d", "bullet-planar"} : std::vector<std::string>{"bullet"}) {
      SCOPED_TRACE(std::string(scene) + ", " + setting + ", " + engine);
      const std::string out = folder / (std::string(scene) + setting + engine);
      const Outcome outcome = talus_command("run questions/" + std::string(scene) + " --no-telemetry --backend " +
                                            engine + " --set '" + setting + "' --out '" + out + "'");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const auto summary = nlohmann::json::parse(contents(out + "/summary.json"));
      const nlohmann::json answer = summary.at(nlohmann::json::json_pointer(key));
      ASSERT_TRUE(answer.is_number()) << summary;
      EXPECT_GE(answer.get<double>(), least);
      EXPECT_LE(answer.get<double>(), most);
    }
  }
}

}  // namespace
}  // namespace talus::questions_test

#endif
