#pragma once
// A scene file that builds upon another: `include = "base.toml"`.

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <string_view>

#include "common/scene/diagnostics.h"

namespace talus {

/// Files that include one another may be this many, one inside the next.
inline constexpr int most_includes = 8;

/// Puts the values of the file that `table` includes, and of the one that this includes, in where the table gives none,
/// and takes the key `include` out. Tables are merged key by key; an array replaces the whole array. The names of
/// files in them are then below the folder of `file_name`, that of the table. Whether there was one. Throws SceneErrors
/// where the file lies elsewhere than in or below the folder of `file_name` or cannot be read, and what `parse` throws.
bool put_in_included(toml::table& table, std::string_view file_name, Diagnostics& diagnostics,
                     const std::function<toml::table(const std::filesystem::path&)>& parse);

}  // namespace talus
