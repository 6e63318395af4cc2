#include "common/scene/setting_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "common/scene/read_scene.h"
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

/// What the scene has of keys that it does not give. Nothing where it cannot be read any more, as without its meshes.
Settings defaults_of(std::string_view toml) {
  try {
    return settings_of(with_every_default(toml, "scene.toml"));
  } catch (const SceneErrors&) {
    return {};
  }
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

std::string value_at(const Settings& settings, const Settings& defaults, const std::string& path) {
  if (const auto given = settings.find(path); given != settings.end()) return given->second;
  const auto usual = defaults.find(path);
  return usual == defaults.end() ? "" : usual->second;
}

}  // namespace

std::vector<SettingDifference> setting_differences(std::string_view toml_a, std::string_view toml_b) {
  const Settings settings_a = settings_of(toml_a);
  const Settings settings_b = settings_of(toml_b);
  const Settings defaults_a = defaults_of(toml_a);
  const Settings defaults_b = defaults_of(toml_b);
  std::map<std::string, SettingDifference> differences;
  for (const auto& [path, value] : settings_a) differences[path] = {path, value, {}};
  for (const auto& [path, value] : settings_b) {
    differences[path].path = path;
    differences[path].b = value;
  }
  std::vector<SettingDifference> list;
  for (const auto& [path, difference] : differences)
    if (!same_value(value_at(settings_a, defaults_a, path), value_at(settings_b, defaults_b, path)))
      list.push_back(difference);
  return list;
}

bool is_of_scene(const SettingDifference& difference) {
  constexpr std::array others = {"title", "run.frames", "run.threads", "run.pace", "run.contacts"};
  return std::ranges::find(others, difference.path) == others.end() && !difference.path.starts_with("policy.");
}

}  // namespace talus
