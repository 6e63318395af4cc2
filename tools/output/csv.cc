#include "tools/output/csv.h"

#include <cerrno>
#include <system_error>

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

GrowingCsv::GrowingCsv(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : file_(file), out_(file) {
  require_written();
  add(columns);
}

void GrowingCsv::add_line(std::string_view line) {
  out_ << line;
  require_written();
}

void GrowingCsv::flush() {
  if (file_.empty()) return;
  out_.flush();
  require_written();
}

/// Throws where the file cannot take what was written, as on a full disk.
void GrowingCsv::require_written() const {
  if (!out_) throw std::system_error(errno, std::generic_category(), file_.string());
}

}  // namespace talus
