#include "common/scene/override.h"

#include <fmt/format.h>

#include <utility>

#include "common/scene/text_limits.h"
#include "common/text/nearest_name.h"
#include "common/text/printable.h"

namespace talus {
namespace {

// The text as a TOML value whose place is "--set ..."; what is no TOML value becomes a string.
toml::table read_value(const std::string& text, const std::string& origin) {
  try {
    toml::table parsed = toml::parse("value = " + text, origin);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    // Taken for a text without quotes; if the scene takes no text here, its reader says so.
  }
  toml::table quoted = toml::parse("value = ''", origin);
  **quoted.get_as<std::string>("value") = text;
  return quoted;
}

bool is_index(const toml::path_component& part) { return part.type() == toml::path_component_type::array_index; }

// The rule that a path breaks where it goes on from `parent` to `part`; empty if none.
std::string broken_rule(const toml::node& parent, const toml::path_component& part) {
  if (is_index(part)) {
    const toml::array* array = parent.as_array();
    if (array == nullptr) return fmt::format("[{}] follows what is no array", part.index());
    const bool inside = part.index() < array->size();
    return inside ? "" : fmt::format("[{}]: there are only {}, counted from 0", part.index(), array->size());
  }
  if (parent.is_array())
    return fmt::format("\"{}\" follows an array: say which of it, as in source[0].rate", part.key());
  return parent.is_table() ? "" : fmt::format("\"{}\" follows what is no table", part.key());
}

// What is wrong with an override; nothing without a rule.
struct BrokenRule {
  std::string rule = {};
  std::string suggestion = {};  // the known name nearest to a wrong one
};

// The rule that a path breaks by going on through a part that `parent` does not have: only tables whose names talus
// gives are made on the way. `at`: the place of the part in `path`.
BrokenRule missing_part(const toml::table& parent, const toml::path& path, std::size_t at) {
  const std::string& name = path[at].key();
  std::vector<std::string> known;
  for (const auto& [key, value] : parent) known.emplace_back(key.str());
  if (is_index(path[at + 1]))
    return {.rule = fmt::format("[{}]: the scene has no {}", path[at + 1].index(), name),
            .suggestion = nearest_name(name, known)};
  if (at != 1 || is_index(path[0]) || path[0].key() != "shape") return {};
  return {.rule = fmt::format("the scene has no shape \"{}\"", name), .suggestion = nearest_name(name, known)};
}

// Puts a value in the place of whatever `parent` has at `part`. Moved, since a copy would forget its origin.
void put(toml::node& parent, const toml::path_component& part, toml::node& value) {
  value.visit([&](auto& typed) {
    if (is_index(part)) {
      toml::array& array = *parent.as_array();
      array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(part.index()), std::move(typed));
    } else {
      parent.as_table()->insert_or_assign(part.key(), std::move(typed));
    }
  });
}

// The node at `part`; a table is made where there is none.
toml::node& enter(toml::node& parent, const toml::path_component& part, const std::string& origin) {
  if (is_index(part)) return *parent.as_array()->get(part.index());
  toml::table& table = *parent.as_table();
  if (!table.contains(part.key())) {
    toml::table made = read_value("{}", origin);
    put(parent, part, *made.get("value"));
    table.get_as<toml::table>(part.key())->is_inline(false);
  }
  return *table.get(part.key());
}

// The rule that the override breaks; without a rule if it was applied.
BrokenRule apply(toml::table& table, const Override& one, const std::string& origin) {
  if (!is_utf8(one.text)) return {.rule = "must be UTF-8"};
  const std::size_t equals = one.text.find('=');
  const std::string_view written = std::string_view(one.text).substr(0, equals);
  const toml::path path(written);
  // The parser of paths takes much for right, such as a bracket without its other half; its text then differs.
  if (equals == std::string::npos || equals == 0 || path.empty() || path.str() != written)
    return {.rule = "must be path=value, the path as in source[0].rate"};
  if (!is_index(path[0]) && path[0].key() == "include") return {.rule = "include must be given in the file"};
  toml::node* parent = &table;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (std::string rule = broken_rule(*parent, path[i]); !rule.empty()) return {.rule = std::move(rule)};
    if (i + 1 == path.size()) break;
    if (const toml::table* table_here = parent->as_table();
        table_here != nullptr && !table_here->contains(path[i].key()))
      if (BrokenRule missing = missing_part(*table_here, path, i); !missing.rule.empty()) return missing;
    parent = &enter(*parent, path[i], origin);
  }
  toml::table value = read_value(one.text.substr(equals + 1), origin);
  put(*parent, path[path.size() - 1], *value.get("value"));
  return {};
}

}  // namespace

void apply_overrides(toml::table& table, std::span<const Override> overrides, std::vector<SceneError>& errors) {
  for (const Override& one : overrides) {
    const std::string origin = one.origin.empty() ? "--set " + shortened(one.text, 200) : one.origin;
    check_scene_text(one.text, origin);
    if (BrokenRule broken = apply(table, one, origin); !broken.rule.empty())
      errors.push_back({origin, 0, 0, "", "", std::move(broken.rule), std::move(broken.suggestion)});
  }
}

}  // namespace talus
