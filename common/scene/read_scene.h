#pragma once
// Scene files. docs/scenes.md describes them.

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "common/scene/diagnostics.h"
#include "common/scene/override.h"
#include "common/scene/scene.h"

namespace talus {

using AnyScene = std::variant<Scene<2>, Scene<3>>;

/// The text of the scene file, with what replaced its values.
inline const std::string& toml_of(const AnyScene& scene) {
  return std::visit([](const auto& of_dimension) -> const std::string& { return of_dimension.toml; }, scene);
}

/// The scene in a TOML file, with `overrides` put in before it is read. Throws SceneErrors with all that is wrong.
AnyScene read_scene(const std::filesystem::path& file, std::span<const Override> overrides = {});

/// The same from a text; `file_name` is for messages.
AnyScene parse_scene(std::string_view text, std::string_view file_name, std::span<const Override> overrides = {});

/// Every key that is looked for while this text is read, right or wrong, as `source[].rate` or `shape.*.kind`; which
/// these are depends on the dimension and the kinds in it. For checking the manual against the reader.
std::set<std::string> keys_looked_for(std::string_view text);

/// The same scene with the default of each key that the text does not give; comments are left out. Throws SceneErrors.
std::string with_every_default(std::string_view text, std::string_view file_name);

}  // namespace talus
