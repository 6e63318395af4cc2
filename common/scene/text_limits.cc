#include "common/scene/text_limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

/// The end of the string that begins at `begin`, a quote. An unfinished string ends with its line, as TOML has it, or
/// with the text if it may have many lines.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string three(3, quote);
  const bool many_lines = text.substr(begin).starts_with(three);
  const std::string_view closing = many_lines ? std::string_view(three) : std::string_view(three).substr(0, 1);
  std::size_t at = begin + closing.size();
  while (at < text.size() && !text.substr(at).starts_with(closing)) {
    if (text[at] == '\n' && !many_lines) return at;
    at += quote == '"' && text[at] == '\\' && !text.substr(at + 1).starts_with('\n') ? 2 : 1;
  }
  at = std::min(text.size(), at + closing.size());
  // Up to two quotes may stand before the closing ones and belong to the text.
  for (int more = 0; many_lines && more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
  return at;
}

/// Where a text breaks the limits of nesting.
struct TooDeep {
  std::size_t at = std::string_view::npos;  // npos: nowhere
  std::string_view what = {};
};

/// Follows dotted names and brackets outside of strings and comments.
class NestingScan {
 public:
  explicit NestingScan(std::string_view text) : text_(text) {}

  TooDeep find() {
    for (std::size_t at = 0; at < text_.size();) {
      const char letter = text_[at];
      follow(letter);
      if (parts_ > max_scene_nesting) return {at, "parts of a dotted name"};
      if (brackets_ > max_scene_nesting) return {at, "arrays and tables inside each other"};
      if (letter == '#')
        at = std::min(text_.size(), text_.find('\n', at));
      else
        at = letter == '"' || letter == '\'' ? end_of_string(text_, at) : at + 1;
    }
    return {};
  }

 private:
  void follow(char letter) {
    constexpr std::string_view separators = "\n=,[]{}";
    if (letter == '.') ++parts_;
    if (separators.find(letter) != std::string_view::npos) parts_ = 1;
    if (letter == '[' || letter == '{') ++brackets_;
    if (letter == ']' || letter == '}') brackets_ = std::max(0, brackets_ - 1);
  }

  std::string_view text_;
  int parts_ = 1;
  int brackets_ = 0;
};

}  // namespace

void check_scene_text_size(std::uintmax_t size, const std::string& file) {
  if (size <= max_scene_text) return;
  throw SceneErrors({{file, 0, 0, "size", fmt::format("{} bytes", size),
                      fmt::format("a scene's text must be at most {} bytes", max_scene_text), ""}});
}

void check_scene_text(std::string_view text, const std::string& file) {
  check_scene_text_size(text.size(), file);
  const TooDeep found = NestingScan(text).find();
  if (found.at == std::string_view::npos) return;
  const std::string_view before = text.substr(0, found.at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t column = found.at - (before.rfind('\n') + 1) + 1;
  throw SceneErrors({{file, static_cast<int>(line), static_cast<int>(column), "", "",
                      fmt::format("{} must be at most {}", found.what, max_scene_nesting), ""}});
}

}  // namespace talus
