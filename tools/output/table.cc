#include "tools/output/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace talus {
namespace {

void check(const Table& table) {
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() == table.columns.size()) continue;
    throw std::invalid_argument(fmt::format("table \"{}\": a row of {} cells, must have {} as there are columns",
                                            table.caption, row.size(), table.columns.size()));
  }
}

std::vector<std::string> header(const Table& table) {
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  return names;
}

/// Characters, not bytes, of a UTF-8 text: bytes that continue a character do not count.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded_line(const Table& table, const std::vector<std::string>& cells,
                        const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string space(widths[i] - width_of(cells[i]), ' ');
    if (i > 0) line += "  ";
    line += table.columns[i].number ? space + cells[i] : cells[i] + space;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

std::string text_of(const Table& table) {
  check(table);
  std::vector<std::size_t> widths;
  for (const Column& column : table.columns) widths.push_back(width_of(column.name));
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  std::string text = table.caption;
  if (!text.empty()) text += '\n';
  text += padded_line(table, header(table), widths);
  std::vector<std::string> rule;
  for (const std::size_t width : widths) rule.emplace_back(width, '-');
  text += padded_line(table, rule, widths);
  for (const auto& row : table.rows) text += padded_line(table, row, widths);
  return text;
}

}  // namespace talus
