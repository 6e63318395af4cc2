#pragma once
// Limits of a text that is given to the TOML parser, whose recursion is as deep as the text is nested.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/scene/diagnostics.h"

namespace talus {

/// Largest scene text [bytes].
inline constexpr std::size_t max_scene_text = std::size_t{1} << 20;

/// Most parts of a dotted name, and most arrays and tables inside each other in one value.
inline constexpr int max_scene_nesting = 8;

/// Throws SceneErrors if a scene text of that many bytes is too large.
void check_scene_text_size(std::uintmax_t size, const std::string& file);

/// Throws SceneErrors if the TOML text is too large or too deeply nested; `file` is for messages. In time proportional
/// to the text's length; a text that is no TOML may pass.
void check_scene_text(std::string_view text, const std::string& file);

}  // namespace talus
