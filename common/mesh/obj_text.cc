#include "common/mesh/obj_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "common/math/require.h"
#include "common/text/file.h"

namespace talus {
namespace {

constexpr std::string_view blanks = " \t";

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t start = line.find_first_not_of(blanks);
  while (start != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
    words.push_back(line.substr(start, end - start));
    start = line.find_first_not_of(blanks, end);
  }
  return words;
}

bool is_coordinate(std::string_view word) {
  constexpr double most = 1e30;  // squares and cubes of it are numbers
  word.remove_prefix(word.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::abs(value) <= most;
}

// The part of a word that fits into a message.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 30));
  for (char& letter : text) letter = letter < ' ' || letter > '~' ? '?' : letter;
  return text;
}

// Goes through the lines in order and notes what later lines may refer to.
class ObjLines {
 public:
  explicit ObjLines(const std::filesystem::path& file) : file_(file.string()) {}

  /// Whether the line is one from which a mesh is read. `lines`: how many of the file's own it was continued over.
  bool check(std::string_view line, int lines) {
    number_ += next_;
    next_ = lines;
    const std::vector<std::string_view> words = words_of(line);
    const std::string_view kind = words.empty() ? "" : words.front();
    if (kind == "v")
      check_corner(words);
    else if (kind == "f")
      check_face(words);
    return kind == "v" || kind == "f" || kind == "o" || kind == "g";
  }

  void check_end() const {
    require(largest_ <= corners_, "mesh file", fmt::format("{}:{}", file_, line_of_largest_),
            fmt::format("a face's corner must be one of the file's {} corners, not {}", corners_, largest_));
  }

 private:
  void require_here(bool holds, const std::string& rule) const {
    if (!holds) require(false, "mesh file", fmt::format("{}:{}", file_, number_), rule);
  }

  void check_corner(const std::vector<std::string_view>& words) {
    require_here(words.size() >= 4, "a corner must be three numbers");
    for (std::size_t i = 1; i <= 3; ++i)
      require_here(is_coordinate(words[i]),
                   "a corner must be three numbers from -1e30 to 1e30, not " + shown(words[i]));
    ++corners_;
  }

  void check_face(const std::vector<std::string_view>& words) {
    const std::size_t count = words.size() - 1;
    require_here(count >= 3 && count <= most_face_corners,
                 fmt::format("a face must have 3 to {} corners, not {}", most_face_corners, count));
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::string_view word = words[i].substr(0, words[i].find('/'));
      long index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool whole = error == std::errc() && end == word.data() + word.size();
      require_here(
          whole && index != 0 && index >= -corners_,
          "a face's corner must be the number of a corner, counted from 1 or back from -1, not " + shown(words[i]));
      if (index > largest_) {
        largest_ = index;
        line_of_largest_ = number_;
      }
    }
  }

  std::string file_;
  long number_ = 1;  // of the line
  int next_ = 0;     // lines from there to the next one
  long corners_ = 0;
  long largest_ = 0;
  long line_of_largest_ = 0;
};

std::string contents_of(const std::filesystem::path& file) {
  std::error_code error;
  const bool readable = std::filesystem::is_regular_file(file, error) && !error;
  const std::uintmax_t size = readable ? std::filesystem::file_size(file, error) : 0;
  require(readable && !error, "mesh file", file.string(), "must be a readable Wavefront OBJ file");
  require(size <= largest_obj_file, "mesh file", file.string(),
          fmt::format("must be at most {} MiB; simplify the mesh", largest_obj_file >> 20));
  std::optional<std::string> contents = file_contents(file);
  require(contents.has_value(), "mesh file", file.string(), "must be a readable Wavefront OBJ file");
  return std::move(*contents);
}

void require_utf8(std::string_view all, const std::filesystem::path& file) {
  const bool utf16 = all.starts_with("\xFF\xFE") || all.starts_with("\xFE\xFF");
  require(!utf16 && all.find('\0') == std::string_view::npos, "mesh file", file.string(),
          utf16 ? "must be text in UTF-8, not in UTF-16" : "must be text in UTF-8, but has zero bytes");
}

/// Cuts a text into lines, without comments at their ends, but for names, which may have a number sign in them. A
/// backslash at the end of a line continues it.
class LineCutter {
 public:
  explicit LineCutter(std::string_view text) : rest_(text) {}

  bool next() {
    if (rest_.empty()) return false;
    line_.clear();
    lines_ = 0;
    do {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      line_ += rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + (rest_.compare(end, 2, "\r\n") == 0 ? 2 : 1), rest_.size()));
      ++lines_;
    } while (continues());
    return true;
  }

  std::string_view line() const {
    const std::size_t first = line_.find_first_not_of(blanks);
    const bool is_name = first != std::string::npos && (line_[first] == 'o' || line_[first] == 'g');
    return std::string_view(line_).substr(0, is_name ? line_.size() : std::min(line_.find('#'), line_.size()));
  }
  int lines() const { return lines_; }

 private:
  bool continues() {
    if (!line_.ends_with('\\')) return false;
    line_.back() = ' ';
    return !rest_.empty();
  }

  std::string_view rest_;
  std::string line_;
  int lines_ = 0;
};

}  // namespace

std::string checked_obj_text(const std::filesystem::path& file) {
  const std::string all = contents_of(file);
  ObjLines lines(file);
  std::string kept;
  kept.reserve(all.size());
  require_utf8(all, file);
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8
  LineCutter text(std::string_view(all).substr(all.starts_with(mark) ? mark.size() : 0));
  while (text.next())
    if (lines.check(text.line(), text.lines())) kept.append(text.line()).push_back('\n');
  lines.check_end();
  return kept;
}

}  // namespace talus
