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

/// The file that the table includes; empty, with an error, if that is none in or below its folder.
std::filesystem::path included_file(const toml::table& table, const std::filesystem::path& folder, std::string_view of,
                                    Diagnostics& diagnostics) {
  const toml::node& node = *table.get("include");
  const std::filesystem::path name(node.value_or(std::string()));
  const bool inside = !name.empty() && name.is_relative() && std::ranges::count(name, "..") == 0;
  if (inside) return folder / name;
  const auto at = node.source().begin;
  diagnostics.errors.push_back({std::string(of), static_cast<int>(at.line), static_cast<int>(at.column), "include",
                                name.string(), "must be a file in or below the scene's folder", ""});
  return {};
}

}  // namespace

bool put_in_included(toml::table& table, std::string_view file_name, Diagnostics& diagnostics,
                     const std::function<toml::table(const std::filesystem::path&)>& parse) {
  const std::filesystem::path folder = std::filesystem::path(file_name).parent_path();
  std::string of(file_name);
  int depth = 0;
  for (; table.contains("include"); ++depth) {
    const std::filesystem::path file = included_file(table, folder, of, diagnostics);
    table.erase("include");
    if (file.empty()) return true;
    of = file.string();
    if (depth >= most_includes || diagnostics.included.contains(of)) {
      diagnostics.errors.push_back(
          {of, 0, 0, "include", "", fmt::format("must end after {} files", most_includes), ""});
      return true;
    }
    diagnostics.included.insert(of);
    toml::table base = parse(file);
    put_in(table, base);
  }
  return depth > 0;
}

}  // namespace talus
