#pragma once
// A table of text for a terminal.

#include <string>
#include <vector>

namespace talus {

struct Column {
  std::string name;
  bool number = false;  // aligned to the right, with digits of one width
};

struct Table {
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  // each as long as `columns`
};

/// As lines for a terminal: columns padded to one width, numbers to the right, the header underlined. Throws
/// std::invalid_argument on rows that differ in length.
std::string text_of(const Table& table);

}  // namespace talus
