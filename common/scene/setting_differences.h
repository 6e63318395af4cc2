#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A setting that two scenes have different values of.
struct SettingDifference {
  std::string path;  // as `source[0].count`
  std::string a;     // as TOML; empty: not given
  std::string b;

  bool operator==(const SettingDifference&) const = default;
};

/// Of two scenes' TOML texts, in the order of their paths; a default that is written out is none. Throws
/// toml::parse_error.
std::vector<SettingDifference> setting_differences(std::string_view toml_a, std::string_view toml_b);

/// Whether a difference makes two runs runs of different scenes: all but the title, the policy, and what of `[run]`
/// changes no step do.
bool is_of_scene(const SettingDifference& difference);

}  // namespace talus
