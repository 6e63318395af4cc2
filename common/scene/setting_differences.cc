#include "common/scene/setting_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

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

/// Numbers that are equal may be written as 30, 30.0 and 0x1E.
bool same_node(const toml::node& a, const toml::node& b) {
  if (a.is_integer() && b.is_integer()) return a.value<std::int64_t>() == b.value<std::int64_t>();
  if (a.is_number() && b.is_number()) return a.value<double>() == b.value<double>();
  const toml::array* many_a = a.as_array();
  const toml::array* many_b = b.as_array();
  if (many_a == nullptr || many_b == nullptr) return value_text(a) == value_text(b);
  return std::ranges::equal(*many_a, *many_b, same_node);
}

bool same_value(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a == b;
  const std::string key = "value";
  return same_node(*toml::parse(key + " = " + a).get(key), *toml::parse(key + " = " + b).get(key));
}

/// What a scene gives, and what it has of the keys that it does not give.
Settings all_settings_of(const SceneTexts& scene) {
  Settings settings = settings_of(scene.toml);
  settings.merge(settings_of(scene.every_default));
  return settings;
}

}  // namespace

std::vector<SettingDifference> setting_differences(const SceneTexts& scene_a, const SceneTexts& scene_b) {
  Settings all_a = all_settings_of(scene_a);
  Settings all_b = all_settings_of(scene_b);
  Settings given = settings_of(scene_a.toml);
  given.merge(settings_of(scene_b.toml));
  std::vector<SettingDifference> list;
  for (const auto& [path, unused] : given)
    if (!same_value(all_a[path], all_b[path])) list.push_back({path, all_a[path], all_b[path]});
  return list;
}

bool is_of_scene(const SettingDifference& difference) {
  constexpr std::array others = {"title", "run.frames", "run.threads", "run.pace", "run.contacts"};
  return std::ranges::find(others, difference.path) == others.end() && !difference.path.starts_with("policy.");
}

}  // namespace talus
