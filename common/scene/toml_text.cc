#include "common/scene/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace talus {
namespace {

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      result += '\\';
      result += letter;
    } else if (letter == '\n') {
      result += "\\n";
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04x}", code);
    } else {
      result += letter;
    }
  }
  return result + '"';
}

bool is_section(const toml::node& node) {
  return node.is_table() || (node.is_array() && node.as_array()->is_homogeneous<toml::table>());
}

// Values come before tables, since what follows a table's head belongs to it; both in the order of the file.
std::vector<std::pair<std::string, const toml::node*>> in_order(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(key_text(key.str()), &node);
  const auto place = [](const toml::node& node) {
    return std::tuple(is_section(node), node.source().begin.line, node.source().begin.column);
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const auto& a, const auto& b) { return place(*a.second) < place(*b.second); });
  return entries;
}

void write_table(const std::string& path, const toml::table& table, std::string& text) {
  for (const auto& [key, node] : in_order(table)) {
    const std::string below = path.empty() ? key : fmt::format("{}.{}", path, key);
    if (!is_section(*node)) {
      text += fmt::format("{} = {}\n", key, value_text(*node));
    } else if (const toml::table* child = node->as_table()) {
      const bool head_says_nothing =
          !child->empty() &&
          std::all_of(child->begin(), child->end(), [](const auto& entry) { return is_section(entry.second); });
      if (!head_says_nothing) text += fmt::format("\n[{}]\n", below);
      write_table(below, *child, text);
    } else {
      for (const toml::node& element : *node->as_array()) {
        text += fmt::format("\n[[{}]]\n", below);
        write_table(below, *element.as_table(), text);
      }
    }
  }
}

}  // namespace

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           letter == '_' || letter == '-';
  });
  return bare ? std::string(key) : in_quotes(key);
}

std::string toml_text(double number) {
  std::string text = fmt::format("{}", number);
  // Without a point it would be read as an integer.
  return text.find_first_of(".ein") == std::string::npos ? text + ".0" : text;
}

std::string toml_text(std::int64_t number) { return fmt::format("{}", number); }
std::string toml_text(bool flag) { return flag ? "true" : "false"; }
std::string toml_text(std::string_view text) { return in_quotes(text); }
std::string toml_array(const std::vector<std::string>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

std::string value_text(const toml::node& node) {
  std::vector<std::string> parts;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) parts.push_back(value_text(element));
    return toml_array(parts);
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, child] : in_order(*table)) parts.push_back(fmt::format("{} = {}", key, value_text(*child)));
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  if (const auto* number = node.as_floating_point()) return toml_text(**number);
  if (const auto* text = node.as_string()) return in_quotes(**text);
  std::ostringstream stream;
  node.visit([&stream](const auto& other) { stream << other; });
  return stream.str();
}

std::string document_text(const toml::table& table) {
  std::string text;
  write_table("", table, text);
  return text;
}

}  // namespace talus
