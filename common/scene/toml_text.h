#pragma once
// TOML back to text, numbers in the shortest form that reads back the same, keys in the order of the file.

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/params/field.h"

namespace talus {

/// A number, flag or text as TOML.
std::string toml_text(double number);
std::string toml_text(std::int64_t number);
std::string toml_text(bool flag);
std::string toml_text(std::string_view text);
/// A key, in quotes where TOML needs them.
std::string key_text(std::string_view key);
/// An array of values that are TOML already.
std::string toml_array(const std::vector<std::string>& values);

/// A value on one line: number, text, array or inline table.
std::string value_text(const toml::node& node);

/// A whole document. Parsing it gives an equal table; comments are not kept.
std::string document_text(const toml::table& table);

/// The value of a field as it is written in a scene file; empty for an optional value that is not given.
template <typename T>
std::string field_text(const Key& key, const T& value) {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    return toml_text(value);
  } else if constexpr (std::is_integral_v<T>) {
    return toml_text(static_cast<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return toml_text(as_written(key, value));
  } else if constexpr (requires { value.has_value(); }) {
    return value ? field_text(key, *value) : "";
  } else {
    std::vector<std::string> parts;
    for (const auto& part : value) parts.push_back(field_text(key, part));
    return toml_array(parts);
  }
}

}  // namespace talus
