#include "tools/monitor/sheet.h"

#include <algorithm>

namespace talus {
namespace {

/// Takes the first character off a valid UTF-8 text; of an invalid one, its first byte as `?`.
char32_t take_character(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first < 0xC0 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length == 0 || length > text.size()) {
    text.remove_prefix(1);
    return U'?';
  }
  constexpr unsigned masks[] = {0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t character = first & masks[length];
  for (std::size_t i = 1; i < length; ++i) character = character << 6U | (byte(i) & 0x3FU);
  text.remove_prefix(length);
  return character;
}

/// Latin, Greek and Cyrillic letters, punctuation, lines, blocks and braille take one cell in each terminal.
bool takes_one_cell(char32_t character) {
  return (character >= 0x20 && character < 0x7F) || (character >= 0xA1 && character != 0xAD && character < 0x300) ||
         (character >= 0x370 && character < 0x483) || (character >= 0x2010 && character < 0x2028) ||
         (character >= 0x2500 && character < 0x25A0) || (character >= 0x2800 && character < 0x2900);
}

void append_utf8(std::string& text, char32_t character) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  const auto code = static_cast<unsigned>(character);
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0U | code >> 6U);
    put(0x80U | (code & 0x3FU));
  } else {
    put(0xE0U | code >> 12U);
    put(0x80U | (code >> 6U & 0x3FU));
    put(0x80U | (code & 0x3FU));
  }
}

}  // namespace

Sheet::Sheet(int rows, int columns)
    : rows_(std::max(rows, 0)), columns_(std::max(columns, 0)), cells_(static_cast<std::size_t>(rows_) * columns_) {}

void Sheet::set(int row, int column, const Cell& cell) {
  if (row >= 0 && row < rows_ && column >= 0 && column < columns_) cells_[index(row, column)] = cell;
}

std::string Sheet::line(int row) const {
  std::string text;
  for (int column = 0; column < columns_; ++column) append_utf8(text, at(row, column).character);
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string Sheet::text() const {
  std::string text;
  for (int row = 0; row < rows_; ++row) text += line(row) + '\n';
  return text;
}

int Area::put(int row, int column, std::string_view text, Style style) const {
  while (!text.empty()) {
    const char32_t character = take_character(text);
    const bool inside = row >= 0 && row < rows_ && column >= 0 && column < columns_;
    if (inside) sheet_->set(row_ + row, column_ + column, {takes_one_cell(character) ? character : U'?', style});
    ++column;
  }
  return column;
}

void Area::put_right(int row, std::string_view text, Style style) const {
  put(row, std::max(columns_ - width_of(text), 0), text, style);
}

Area Area::part(int row, int column, int rows, int columns) const {
  row = std::clamp(row, 0, rows_);
  column = std::clamp(column, 0, columns_);
  return {*sheet_, row_ + row, column_ + column, std::clamp(rows, 0, rows_ - row),
          std::clamp(columns, 0, columns_ - column)};
}

int width_of(std::string_view text) {
  int cells = 0;
  for (; !text.empty(); ++cells) take_character(text);
  return cells;
}

}  // namespace talus
