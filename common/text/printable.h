#pragma once
// Text from files and from the network, on its way to a terminal.

#include <string>
#include <string_view>

namespace talus {

/// `text` as valid UTF-8 without control characters: each byte that is not UTF-8, each control character (C0, DEL, C1)
/// and each character that changes the direction or the line of a text becomes `?`. Nothing left of it can move a
/// cursor, change a colour, or hide a word.
std::string printable(std::string_view text);

/// The same, with line feeds kept.
std::string printable_lines(std::string_view text);

}  // namespace talus
