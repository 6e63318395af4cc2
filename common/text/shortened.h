#pragma once

#include <cstddef>
#include <string>

namespace talus {

/// A UTF-8 text of more than `longest` bytes cut there, in front of the letter that would be split, and "..." put after
/// it.
inline std::string shortened(std::string text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0u) == 0x80u) --longest;
  text.resize(longest);
  return text + "...";
}

}  // namespace talus
