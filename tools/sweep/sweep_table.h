#pragma once
// What the runs of a sweep gave, as files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/sweep/sweep_plan.h"

namespace talus {

/// A number of summary.json that is a column of the table.
struct SweepMeasure {
  std::string_view name;   // of the column
  std::string_view key;    // in summary.json, as a JSON pointer
  std::string_view label;  // of the axis of a plot, with unit
};

/// All such columns, in their order.
std::vector<SweepMeasure> sweep_measures();

/// A finished run. Where the summary has no number, the measure is empty.
struct SweepRow {
  int run = 0;
  std::vector<std::string> values;             // of the axes
  std::vector<std::optional<double>> numbers;  // of the measures
  std::string reason;                          // that the run ended
  std::string end_hash;
};

/// The row of a run folder. Throws std::runtime_error where it has no summary that can be read.
SweepRow sweep_row(int number, const SweepRun& run, const std::filesystem::path& folder);

/// Writes sweep.csv, over a file that is there.
void write_sweep_csv(const std::filesystem::path& file, const std::vector<SweepAxis>& axes,
                     const std::vector<SweepRow>& rows);

/// A measure over the first axis that has several numbers, a curve for each combination of the other axes but `seed`,
/// over whose values the mean is taken with its standard error. Nothing is drawn, and false returned, where there is no
/// such axis, or more than seven curves.
bool write_sweep_plot(const std::filesystem::path& file, const std::string& title, const std::vector<SweepAxis>& axes,
                      const std::vector<SweepRow>& rows, std::string_view measure);

}  // namespace talus
