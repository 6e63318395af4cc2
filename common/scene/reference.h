#pragma once
// The tables of docs/scenes.md, made from the declarations of the fields.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// Markdown tables of all keys with the name of the table of the scene file to which they belong: `[world]`,
/// `[[pile]]`, `root`; those of a kind of shape with `[shape.NAME] ring`.
std::vector<std::pair<std::string, std::string>> key_tables();

/// The document with new text between its pairs of marks. `<!-- keys: NAME -->` begins the table of that name
/// and `<!-- end -->` ends it. Throws std::invalid_argument where there is none, and with the line of a mark that has
/// no such name or no end.
std::string with_reference(std::string_view document);

}  // namespace talus
