#include "common/scene/include.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

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

/// The file that the table includes; empty, with an error, if that is none in or below its folder, or is read already.
std::filesystem::path included_file(const toml::table& table, std::string_view scene, std::string_view of,
                                    Diagnostics& diagnostics) {
  const toml::node& node = *table.get("include");
  const std::filesystem::path name(node.value_or(std::string()));
  const auto at = node.source().begin;
  const auto refuse = [&](std::string rule) -> std::filesystem::path {
    diagnostics.errors.push_back({std::string(of), static_cast<int>(at.line), static_cast<int>(at.column), "include",
                                  name.string(), std::move(rule), ""});
    return {};
  };
  const bool inside = !name.empty() && name.is_relative() && std::ranges::count(name, "..") == 0;
  if (!inside) return refuse("must be a file in or below the scene's folder");
  std::filesystem::path file = std::filesystem::path(scene).parent_path() / name;
  if (file == std::filesystem::path(scene) || diagnostics.included.contains(file.string()))
    return refuse("must not lead back to a file that includes it");
  if (std::ssize(diagnostics.included) >= most_includes)
    return refuse(fmt::format("must end after {} files", most_includes));
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
    if (file.empty()) break;
    of = file.string();
    diagnostics.included.insert(of);
    toml::table base = parse(file);
    put_in(table, base);
  }
  return any;
}

}  // namespace talus
