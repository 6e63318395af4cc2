#pragma once

#include <string>
#include <vector>

namespace talus {

/// A setting that two scenes have different values of.
struct SettingDifference {
  std::string path;  // as `source[0].count`
  std::string a;     // as TOML, a default too; empty: it has none
  std::string b;

  bool operator==(const SettingDifference&) const = default;
};

/// A scene as it is given, and as with_every_default() makes it; empty where it cannot be read any more.
struct SceneTexts {
  std::string toml;
  std::string every_default;
};

/// Of two scenes, in the order of their paths; a default that is written out is none. Throws toml::parse_error.
std::vector<SettingDifference> setting_differences(const SceneTexts& scene_a, const SceneTexts& scene_b);

/// Whether a difference makes two runs runs of different scenes: all but the title, the policy, and what of `[run]`
/// changes no step do.
bool is_of_scene(const SettingDifference& difference);

}  // namespace talus
