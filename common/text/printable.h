#pragma once
// Foreign text in messages: made safe for a terminal, and short.

#include <cstddef>
#include <string>
#include <string_view>

namespace talus {

bool is_utf8(std::string_view text);

/// `text` as valid UTF-8 without control characters: each byte that is not UTF-8, each control character (C0, DEL, C1)
/// and each character that changes the direction or the line of a text becomes `?`. Nothing left of it can move a
/// cursor, change a colour, or hide a word.
std::string printable(std::string_view text);

/// The same, with line feeds kept.
std::string printable_lines(std::string_view text);

/// A UTF-8 text of more than `longest` bytes cut there, in front of the letter that would be split, and "..." put after
/// it.
inline std::string shortened(std::string text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0u) == 0x80u) --longest;
  text.resize(longest);
  return text + "...";
}

}  // namespace talus
