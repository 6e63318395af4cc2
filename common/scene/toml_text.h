#pragma once
// TOML back to text, numbers as short as they can be told apart and keys in the order of the file.

#include <toml++/toml.h>

#include <string>

namespace talus {

/// A value on one line: number, text, array or inline table.
std::string value_text(const toml::node& node);

/// A whole document. Parsing it gives an equal table; comments are not kept.
std::string document_text(const toml::table& table);

}  // namespace talus
