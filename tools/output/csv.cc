#include "tools/output/csv.h"

namespace talus {

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    const bool quoted = cell.find_first_of(",\"\n") != std::string::npos;
    if (quoted) line += '"';
    for (const char letter : cell) line += quoted && letter == '"' ? std::string("\"\"") : std::string(1, letter);
    if (quoted) line += '"';
  }
  return line + '\n';
}

}  // namespace talus
