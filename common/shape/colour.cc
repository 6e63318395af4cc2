#include "common/shape/colour.h"

#include <algorithm>
#include <cctype>

namespace talus {

std::optional<std::string> colour_text(std::string_view text) {
  for (const auto& [name, colour] : named_colours)
    if (text == name) return std::string(colour);
  constexpr std::size_t length = 7;
  const auto is_digit = [](unsigned char letter) { return std::isxdigit(letter) != 0; };
  if (text.size() != length || text.front() != '#' || !std::ranges::all_of(text.substr(1), is_digit))
    return std::nullopt;
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return lower;
}

}  // namespace talus
