#pragma once
// Colours as scene files name them.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace talus {

/// Names with their colours: Okabe and Ito's where they have one, so that shapes named by them stay apart for
/// colour-blind eyes; else those of CSS.
inline constexpr auto named_colours = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"black", "#000000"},
    {"blue", "#0072b2"},
    {"brown", "#8b5a2b"},
    {"green", "#009e73"},
    {"grey", "#808080"},
    {"orange", "#e69f00"},
    {"pink", "#cc79a7"},
    {"purple", "#800080"},
    {"red", "#d55e00"},
    {"sky", "#56b4e9"},
    {"white", "#ffffff"},
    {"yellow", "#f0e442"},
});

/// "#rrggbb" in lower case of a name or of such a text; none for any other text.
std::optional<std::string> colour_text(std::string_view text);

}  // namespace talus
