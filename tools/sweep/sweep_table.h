#pragma once
// What the runs of a sweep gave, as files.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/text/file.h"
#include "tools/output/csv.h"
#include "tools/plot/plot.h"
#include "tools/sweep/sweep_plan.h"

namespace talus {

/// A number of summary.json that is a column of the table.
struct SweepMeasure {
  std::string_view name;   // of the column
  std::string_view key;    // in summary.json, as a JSON pointer
  std::string_view label;  // of the axis of a plot, with unit
};

/// All such columns, in their order. The last one is `plotted`, where that is a JSON pointer, which must outlive them.
std::vector<SweepMeasure> sweep_measures(std::string_view plotted);

/// A run that has ended. Where the summary has no number, the measure is empty.
struct SweepRow {
  int run = 0;
  std::vector<std::string> values;             // of the axes
  std::vector<std::optional<double>> numbers;  // of the measures
  std::string reason;                          // that the run ended
  std::string end_hash;
};

/// The row of a run, from its summary.json.
SweepRow sweep_row(int number, const SweepRun& run, const nlohmann::json& summary, std::string_view plotted);

/// Whether a run's summary has what is plotted, where that is no column of all tables.
bool has_plotted(const nlohmann::json& summary, std::string_view plotted);

/// Takes the rows one by one into sweep.csv and into the sums that sweep.svg shows: memory does not grow with the rows.
class SweepTable {
 public:
  /// Replaces the file at once in finish(); until then an old one stays. Each call throws std::system_error where the
  /// file cannot be written.
  SweepTable(const std::filesystem::path& file, std::vector<SweepAxis> axes, std::string_view plotted_measure);
  void add(const SweepRow& row);
  void finish();

  /// Writes a plot of the measure over the first axis that has several numbers, a curve for each combination of the
  /// other axes but `seed`, over whose values the mean is taken with its standard error. Writes
  /// nothing and returns why where there is no such axis or number, or more than seven curves.
  std::string write_plot(const std::filesystem::path& file, const std::string& title) const;

  /// Of each point with several seeds: the mean of the measure with its standard error.
  std::vector<std::string> lines() const;

 private:
  /// The values of one point of a curve.
  struct Sample {
    double sum = 0.0;
    double squares = 0.0;
    int count = 0;
    double mean() const { return sum / count; }
    double standard_error() const;
  };
  using Points = std::map<double, Sample>;

  static Series series_of(const std::string& name, const Points& points);

  UnfinishedFile file_;
  std::vector<SweepAxis> axes_;
  std::vector<SweepMeasure> measures_;
  std::size_t measure_ = 0;
  std::optional<std::size_t> along_;  // the axis along which to plot
  GrowingCsv csv_;
  std::map<std::string, Points> curves_;
};

}  // namespace talus
