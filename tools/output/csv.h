#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A line of a CSV file with its end: cells with a comma, a quote or a line end are quoted.
std::string csv_line(const std::vector<std::string>& cells);

/// A CSV file that grows with a run; made without a name it is none. Each call throws std::system_error with the file's
/// name where it cannot be written.
class GrowingCsv {
 public:
  GrowingCsv() = default;
  GrowingCsv(const std::filesystem::path& file, const std::vector<std::string>& columns);
  void add(const std::vector<std::string>& cells) { add_line(csv_line(cells)); }
  /// A row as it stands in the file, with its end.
  void add_line(std::string_view line);
  void flush();

 private:
  void require_written() const;

  std::filesystem::path file_;
  std::ofstream out_;
};

}  // namespace talus
