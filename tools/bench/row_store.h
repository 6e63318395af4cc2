#pragma once

#include <filesystem>
#include <fstream>
#include <functional>

#include "tools/bench/row.h"

namespace talus {

/// Rows in a file of comma-separated values, one appended as soon as it is measured, so that a benchmark that was
/// stopped goes on where it was.
class RowStore {
 public:
  /// Reads the rows that `file` has; a last line that was cut is dropped. Throws std::invalid_argument where the file
  /// is something else, std::runtime_error where it cannot be written.
  explicit RowStore(const std::filesystem::path& file);

  /// The row of this key, or nullptr.
  const Row* find(const RowKey& key) const;

  /// Appends and flushes; a row of the same key must not be there yet.
  void add(const Row& row);

  std::span<const Row> rows() const { return rows_; }

  /// Rows of all rounds of a case, in their order; `key.round` is not looked at, and rounds that are no number are left
  /// out.
  std::vector<const Row*> rounds(const RowKey& key) const;

 private:
  std::vector<Row> rows_;
  std::ofstream out_;
};

/// Cells of one line of comma-separated values (RFC 4180, no line breaks in cells).
std::vector<std::string> cells_of(const std::string& line);

}  // namespace talus
