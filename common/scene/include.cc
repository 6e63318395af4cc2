#include "common/scene/include.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include "common/scene/toml_text.h"
#include "common/text/file.h"

namespace talus {
namespace {

/// Values are moved, since a copy would forget its place in its file.
void put_in(toml::table& table, toml::table& base) {
  for (auto&& [key, value] : base) {
    toml::node* own = table.get(key);
    if (own == nullptr)
      value.visit([&table, &key = key](auto& typed) { table.insert(key, std::move(typed)); });
    else if (own->is_table() && value.is_table())
      put_in(*own->as_table(), *value.as_table());
  }
}

/// Puts `folder` before the names of files in or below it.
void name_from_above(toml::node& node, const std::filesystem::path& folder) {
  if (toml::array* array = node.as_array())
    for (toml::node& each : *array) name_from_above(each, folder);
  toml::table* table = node.as_table();
  if (table == nullptr) return;
  for (auto&& [key, value] : *table) {
    toml::value<std::string>* name = key == "file" ? value.as_string() : nullptr;
    if (name == nullptr)
      name_from_above(value, folder);
    else if (!name->get().empty())
      name->get() = (folder / name->get()).string();
  }
}

/// The file that the table includes. Throws SceneErrors if that is none in or below its folder, or is read already.
std::filesystem::path included_file(const toml::table& table, std::string_view scene, const std::string& of,
                                    const Diagnostics& diagnostics) {
  const toml::node& node = *table.get("include");
  const std::filesystem::path name(node.value_or(std::string()));
  const auto at = node.source().begin;
  const auto require = [&](bool holds, std::string rule) {
    if (!holds)
      throw SceneErrors({{of, static_cast<int>(at.line), static_cast<int>(at.column), "include", value_text(node),
                          std::move(rule), ""}});
  };
  const bool inside = !name.empty() && name.is_relative() && std::ranges::count(name, "..") == 0;
  require(inside, "must be a file in or below the scene's folder");
  std::filesystem::path file = std::filesystem::path(scene).parent_path() / name;
  require(file != std::filesystem::path(scene) && !diagnostics.included.contains(file.string()),
          "must not lead back to a file that includes it");
  require(std::ssize(diagnostics.included) < most_includes, fmt::format("must end after {} files", most_includes));
  std::error_code unused;
  require(name.string().find('\0') == std::string::npos && std::filesystem::is_regular_file(file, unused) &&
              std::ifstream(file).good(),
          readable_rule);
  return file;
}

}  // namespace

bool put_in_included(toml::table& table, std::string_view file_name, Diagnostics& diagnostics,
                     const std::function<toml::table(const std::filesystem::path&)>& parse) {
  std::string of(file_name);
  bool any = false;
  while (table.contains("include")) {
    any = true;
    const std::filesystem::path file = included_file(table, file_name, of, diagnostics);
    table.erase("include");
    of = file.string();
    diagnostics.included.insert(of);
    toml::table base = parse(file);
    name_from_above(base, file.parent_path().lexically_relative(std::filesystem::path(file_name).parent_path()));
    put_in(table, base);
  }
  return any;
}

}  // namespace talus
