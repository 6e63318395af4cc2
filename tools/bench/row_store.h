#pragma once
// Measured rows, and the file that keeps them.

#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bench/measure.h"

namespace talus {

/// What a row measured: time and end hash, or the errors against a baseline.
enum class Pass {
  timing,
  against_full,       // the full run at the same settings
  against_reference,  // the converged full run
};

/// "timing", "against_full", "against_reference": as in files and in progress lines.
std::string name_of(Pass pass);

/// What a row is about. Two rows of one key measured the same thing in the same build.
struct RowKey {
  std::string scene;
  std::string backend;
  std::string policy;
  /// Overrides of the scene file with spaces between; empty: as in the scene file.
  std::string settings;
  /// Version of talus with its commit.
  std::string version;
  Pass pass = Pass::timing;
  /// Number of a timed run, from 1; 0 in the other passes.
  int round = 0;

  auto operator<=>(const RowKey&) const = default;
};

struct Row {
  RowKey key;
  /// Of a timed run.
  std::string end_hash;
  Values values;
};

/// A row as a line of JSON with its end of line, and back. Throws std::exception on a text that is no such row.
std::string line_of(const Row& row);
Row row_of(const std::string& line);

/// Rows in a file of JSON lines, one appended as soon as it is measured, so that a benchmark that was stopped goes on
/// where it was.
class RowStore {
 public:
  /// Reads the rows of `file`; a last line that was cut is dropped. Throws std::invalid_argument with file and line
  /// where the file holds anything else, std::runtime_error where it cannot be written.
  explicit RowStore(const std::filesystem::path& file);

  /// The row of this key, or nullptr.
  const Row* find(const RowKey& key) const;

  /// Appends and flushes; a row of the same key must not be there yet.
  void add(const Row& row);

  std::span<const Row> rows() const { return rows_; }

  /// The timed rows of a case, by round; pass and round of `key` do not matter.
  std::vector<const Row*> rounds(RowKey key) const;

 private:
  std::filesystem::path file_;
  std::vector<Row> rows_;
  std::ofstream out_;
};

}  // namespace talus
