#include "common/scene/setting_differences.h"

#include <fmt/format.h>

#include <map>

#include "common/scene/toml_text.h"

namespace talus {
namespace {

using Settings = std::map<std::string, std::string>;

void flatten(const std::string& path, const toml::node& node, Settings& settings) {
  const toml::array* array = node.as_array();
  if (const toml::table* table = node.as_table())
    for (const auto& [key, child] : *table)
      flatten(path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()), child, settings);
  else if (array != nullptr && array->is_homogeneous<toml::table>())
    for (std::size_t i = 0; i < array->size(); ++i) flatten(fmt::format("{}[{}]", path, i), *array->get(i), settings);
  else
    settings[path] = value_text(node);
}

Settings settings_of(std::string_view toml) {
  Settings settings;
  flatten("", toml::parse(toml), settings);
  return settings;
}

/// Numbers that are equal may be written as 30 and 30.0.
bool same_value(const std::string& a, const std::string& b) { return a == b || a + ".0" == b || a == b + ".0"; }

}  // namespace

std::vector<SettingDifference> setting_differences(std::string_view toml_a, std::string_view toml_b) {
  const Settings settings_a = settings_of(toml_a);
  const Settings settings_b = settings_of(toml_b);
  std::map<std::string, SettingDifference> differences;
  for (const auto& [path, value] : settings_a) differences[path] = {path, value, {}};
  for (const auto& [path, value] : settings_b) {
    differences[path].path = path;
    differences[path].b = value;
  }
  std::vector<SettingDifference> list;
  for (const auto& [path, difference] : differences)
    if (!same_value(difference.a, difference.b)) list.push_back(difference);
  return list;
}

bool is_of_scene(const SettingDifference& difference) {
  return difference.path != "title" && difference.path != "run.frames" && !difference.path.starts_with("policy.");
}

}  // namespace talus
