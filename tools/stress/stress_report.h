#pragma once
// What `talus stress` prints and leaves.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/report/html_report.h"
#include "tools/stress/stress_run.h"

namespace talus {

/// One line for each case, quantity and engine, a column for each policy; red cells are marked.
Table stress_table(const std::vector<StressRow>& rows);

/// The cells that are red, each with its reason.
Table red_table(const std::vector<StressRow>& rows);

/// Of cases that differ in one number, such as stack-5, stack-10: the numbers at which an engine passes under a policy.
Table window_table(const std::vector<StressRow>& rows);

/// "312 cells: 300 pass, 8 are known to be red, 1 is red, 3 are refused".
std::string in_short(const std::vector<StressRow>& rows);

/// A row of stress.csv: a measured value with the version that gave it.
struct StressRecord {
  std::string version;
  std::string date;
  StressRow row;
};

/// The rows of a stress.csv; none where there is no such file. Throws std::invalid_argument where it is another file.
std::vector<StressRecord> read_history(const std::filesystem::path& file);

/// Puts the rows into the file as those of this version: rows that are there of the same version, case, engine and
/// policy are replaced. Returns all that it then has.
std::vector<StressRecord> append_history(const std::filesystem::path& file, const std::vector<StressRow>& rows);

/// For each case of which the history has two versions or more: each measured quantity over the versions.
std::vector<Figure> history_figures(const std::vector<StressRecord>& history);

/// The sections of report.html and limits.md.
std::vector<Section> stress_sections(const std::vector<StressRow>& rows);

}  // namespace talus
