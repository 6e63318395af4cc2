#pragma once
// A page of characters, as a terminal shows it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

enum class Style : std::uint8_t { plain, quiet, strong, awake, asleep, good, alert };

/// Rows and columns of characters that take one cell each. What does not fit is left out; a character that may take no
/// cell or two becomes `?`.
class Sheet {
 public:
  struct Cell {
    char32_t character = U' ';
    Style style = Style::plain;
  };

  Sheet(int rows, int columns);
  int rows() const { return rows_; }
  int columns() const { return columns_; }

  const Cell& at(int row, int column) const { return cells_[index(row, column)]; }
  void set(int row, int column, const Cell& cell);

  /// A row as UTF-8, without the blanks at its end.
  std::string line(int row) const;
  /// All rows, each ended by a line feed.
  std::string text() const;

 private:
  std::size_t index(int row, int column) const { return static_cast<std::size_t>(row) * columns_ + column; }

  int rows_;
  int columns_;
  std::vector<Cell> cells_;
};

/// A rectangle of a sheet, to draw in. Rows and columns count from its corner.
class Area {
 public:
  explicit Area(Sheet& sheet) : Area(sheet, 0, 0, sheet.rows(), sheet.columns()) {}

  int rows() const { return rows_; }
  int columns() const { return columns_; }

  /// Writes UTF-8 from a cell to the right; returns the column behind it.
  int put(int row, int column, std::string_view text, Style style = Style::plain) const;
  /// Writes so that the text ends at the right edge.
  void put_right(int row, std::string_view text, Style style = Style::plain) const;

  /// A part of it, as much of it as lies inside.
  Area part(int row, int column, int rows, int columns) const;
  Area lower(int from_row) const { return part(from_row, 0, rows_, columns_); }
  Area upper(int rows) const { return part(0, 0, rows, columns_); }

 private:
  Area(Sheet& sheet, int row, int column, int rows, int columns)
      : sheet_(&sheet), row_(row), column_(column), rows_(rows), columns_(columns) {}

  Sheet* sheet_;
  int row_;
  int column_;
  int rows_;
  int columns_;
};

/// Cells that a text takes.
int width_of(std::string_view text);

}  // namespace talus
