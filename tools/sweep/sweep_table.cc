#include "tools/sweep/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/text/file.h"
#include "tools/output/csv.h"
#include "tools/plot/plot.h"

namespace talus {
namespace {

constexpr std::size_t most_curves = 7;

std::optional<double> number_in(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Names of all columns.
std::vector<std::string> columns_of(const std::vector<SweepAxis>& axes) {
  std::vector<std::string> columns = {"run"};
  for (const SweepAxis& axis : axes) columns.push_back(axis.path);
  columns.insert(columns.end(), {"reason", "end_hash"});
  for (const SweepMeasure& measure : sweep_measures()) columns.emplace_back(measure.name);
  return columns;
}

/// The values of one point of a curve.
struct Sample {
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  double mean() const { return sum / count; }
  double standard_error() const {
    if (count < 2) return 0.0;
    return std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1)) / count);
  }
};

using Curves = std::map<std::string, std::map<double, Sample>>;

/// The axis along which to plot: the first but `seed` with several values that are all numbers.
std::optional<std::size_t> plotted_axis(const std::vector<SweepAxis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool numbers =
        std::ranges::all_of(axes[i].values, [](const auto& value) { return number_in(value).has_value(); });
    if (numbers && axes[i].values.size() > 1 && axes[i].path != "seed") return i;
  }
  return std::nullopt;
}

/// The name of the curve that a run belongs to: its values of the other axes that vary.
std::string curve_of(const std::vector<SweepAxis>& axes, const SweepRow& row, std::size_t plotted) {
  std::string name;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (i != plotted && axes[i].path != "seed" && axes[i].values.size() > 1)
      name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", axes[i].path, row.values[i]);
  return name.empty() ? "mean" : name;
}

/// With bars where a point has several seeds.
Series series_of(const std::string& name, const std::map<double, Sample>& points) {
  const bool bars = std::ranges::any_of(points, [](const auto& point) { return point.second.count > 1; });
  Series series{.name = name, .x = {}, .y = {}, .style = SeriesStyle::line_and_points};
  for (const auto& [x, sample] : points) {
    series.x.push_back(x);
    series.y.push_back(sample.mean());
    if (!bars) continue;
    series.low.push_back(sample.mean() - sample.standard_error());
    series.high.push_back(sample.mean() + sample.standard_error());
  }
  return series;
}

}  // namespace

std::vector<SweepMeasure> sweep_measures() {
  return {{"bodies", "/bodies", "bodies"},
          {"bodies_lost", "/bodies_lost", "bodies lost"},
          {"steps", "/steps", "steps"},
          {"mean_awake", "/mean_awake", "bodies awake in the mean"},
          {"asleep_at_end", "/asleep_at_end", "bodies asleep at the end"},
          {"work_skipped", "/work_skipped", "share of body-steps skipped"},
          {"ms_per_step", "/ms_per_step", "time of a step [ms]"},
          {"wall_s", "/wall_s", "time of the run [s]"},
          {"height_m", "/shape/height_m", "height of the pile [m]"},
          {"centre_height_m", "/shape/centre_height_m", "height of the centre of mass [m]"},
          {"r50_m", "/shape/r50_m", "radius that holds half the bodies [m]"},
          {"r95_m", "/shape/r95_m", "radius that holds 95 % of the bodies [m]"},
          {"angle_of_repose_deg", "/shape/angle_of_repose_deg", "angle of repose [degrees]"},
          {"packing", "/shape/packing", "packing density"},
          {"drift_D", "/estimate/drift_D", "estimated drift [D]"},
          {"measured_drift_D", "/measured/drift_mean_D", "measured drift [D]"}};
}

SweepRow sweep_row(int number, const SweepRun& run, const std::filesystem::path& folder) {
  std::ifstream stream(folder / "summary.json");
  const auto summary = nlohmann::json::parse(stream, nullptr, false);
  if (!summary.is_object()) throw std::runtime_error(fmt::format("{}: has no summary.json", folder.string()));
  SweepRow row{.run = number,
               .values = run.values,
               .numbers = {},
               .reason = summary.value("reason", ""),
               .end_hash = summary.value("end_hash", "")};
  for (const SweepMeasure& measure : sweep_measures()) {
    const nlohmann::json::json_pointer key{std::string(measure.key)};
    const bool given = summary.contains(key) && summary.at(key).is_number();
    row.numbers.push_back(given ? std::optional(summary.at(key).get<double>()) : std::nullopt);
  }
  return row;
}

void write_sweep_csv(const std::filesystem::path& file, const std::vector<SweepAxis>& axes,
                     const std::vector<SweepRow>& rows) {
  std::string table = csv_line(columns_of(axes));
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = {fmt::format("{}", row.run)};
    cells.insert(cells.end(), row.values.begin(), row.values.end());
    cells.insert(cells.end(), {row.reason, row.end_hash});
    for (const std::optional<double>& number : row.numbers)
      cells.push_back(number ? fmt::format("{:.9g}", *number) : "");
    table += csv_line(cells);
  }
  write_file(file, table);
}

bool write_sweep_plot(const std::filesystem::path& file, const std::string& title, const std::vector<SweepAxis>& axes,
                      const std::vector<SweepRow>& rows, std::string_view measure) {
  const std::vector<SweepMeasure> measures = sweep_measures();
  const auto which = std::ranges::find(measures, measure, &SweepMeasure::name);
  const std::optional<std::size_t> along = plotted_axis(axes);
  if (which == measures.end() || !along) return false;
  Curves curves;
  for (const SweepRow& row : rows) {
    const std::optional<double> y = row.numbers[which - measures.begin()];
    if (!y || row.reason != "finished") continue;
    Sample& sample = curves[curve_of(axes, row, *along)][*number_in(row.values[*along])];
    sample.sum += *y;
    sample.squares += *y * *y;
    ++sample.count;
  }
  if (curves.empty() || curves.size() > most_curves) return false;
  int most_seeds = 0;
  for (const auto& [name, points] : curves)
    for (const auto& [x, sample] : points) most_seeds = std::max(most_seeds, sample.count);
  const std::string bars =
      most_seeds > 1 ? fmt::format(" (bars: standard error of the mean of {} seeds)", most_seeds) : "";
  Plot plot{.title = title, .x_label = axes[*along].path + bars, .y_label = std::string(which->label), .series = {}};
  for (const auto& [name, points] : curves) plot.series.push_back(series_of(name, points));
  write_file(file, svg_of(plot));
  return true;
}

}  // namespace talus
