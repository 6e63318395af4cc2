#include "tools/bench/row_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "tools/report/table.h"

namespace talus {

namespace {

constexpr std::size_t key_columns = 7;  // six of the key and the hash

/// A table of one line without its header, to quote as all tables do.
std::string line_of(const std::vector<std::string>& cells) {
  Table table{"", std::vector<Column>(cells.size()), {cells}};
  const std::string text = csv_of(table);
  return text.substr(text.find('\n') + 1);
}

std::string header() {
  std::vector<std::string> cells = {"scene", "backend", "policy", "settings", "round", "version", "end_hash"};
  for (const char* name : measure_names()) cells.emplace_back(name);
  return line_of(cells);
}

std::string line_of(const Row& row) {
  std::vector<std::string> cells = {row.key.scene, row.key.backend, row.key.policy, row.key.settings,
                                    row.key.round, row.key.version, row.end_hash};
  for (const char* name : measure_names()) {
    const double value = value_of(row.values, name);
    cells.push_back(std::isfinite(value) ? fmt::format("{}", value) : "");
  }
  return line_of(cells);
}

Row row_of(const std::vector<std::string>& cells) {
  Row row{{cells[0], cells[1], cells[2], cells[3], cells[4], cells[5]}, cells[6], {}};
  const auto names = measure_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& cell = cells[key_columns + i];
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (!cell.empty() && error == std::errc()) row.values[names[i]] = value;
  }
  return row;
}

std::vector<Row> read(const std::filesystem::path& file) {
  std::vector<Row> rows;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!std::getline(in, line)) return rows;
  if (line + '\n' != header()) {
    throw std::invalid_argument(
        fmt::format("{}: must have the columns of this build's rows; move it away to start anew", file.string()));
  }
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (in.eof() || cells.size() != key_columns + measure_names().size()) break;
    rows.push_back(row_of(cells));
  }
  return rows;
}

}  // namespace

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += c;
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

RowStore::RowStore(const std::filesystem::path& file) : rows_(read(file)) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  const std::filesystem::path fresh = file.string() + ".new";
  out_.open(fresh, std::ios::binary);
  out_ << header();
  for (const Row& row : rows_) out_ << line_of(row);
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written", fresh.string()));
  std::filesystem::rename(fresh, file);
}

const Row* RowStore::find(const RowKey& key) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.key == key; });
  return found == rows_.end() ? nullptr : &*found;
}

void RowStore::add(const Row& row) {
  assert(find(row.key) == nullptr);
  rows_.push_back(row);
  out_ << line_of(row);
  out_.flush();
  if (!out_) throw std::runtime_error("rows.csv: cannot be written");
}

std::vector<const Row*> RowStore::rounds(const RowKey& key) const {
  std::vector<const Row*> found;
  for (const Row& row : rows_) {
    RowKey other = row.key;
    if (other.round.find_first_not_of("0123456789") != std::string::npos) continue;
    other.round = key.round;
    if (other == key) found.push_back(&row);
  }
  return found;
}

}  // namespace talus
