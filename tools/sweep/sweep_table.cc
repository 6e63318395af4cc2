#include "tools/sweep/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/text/file.h"

namespace talus {
namespace {

constexpr std::size_t most_curves = 7;

std::optional<double> number_at(const nlohmann::json& summary, const nlohmann::json::json_pointer& key) {
  try {
    const bool given = summary.contains(key) && summary.at(key).is_number();
    return given ? std::optional(summary.at(key).get<double>()) : std::nullopt;
  } catch (const nlohmann::json::out_of_range&) {
    return std::nullopt;  // an index that no array can have
  }
}

/// Names of all columns.
std::vector<std::string> columns_of(const std::vector<SweepAxis>& axes, const std::vector<SweepMeasure>& measures) {
  std::vector<std::string> columns = {"run"};
  for (const SweepAxis& axis : axes) columns.push_back(axis.path);
  columns.insert(columns.end(), {"reason", "end_hash"});
  for (const SweepMeasure& measure : measures) columns.emplace_back(measure.name);
  return columns;
}

/// The axis along which to plot: the first but `seed` with several values that are all numbers.
std::optional<std::size_t> plotted_axis(const std::vector<SweepAxis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const bool numbers =
        std::ranges::all_of(axes[i].values, [](const auto& value) { return number_of(value).has_value(); });
    if (numbers && axes[i].values.size() > 1 && axes[i].path != "seed") return i;
  }
  return std::nullopt;
}

/// The name of the curve that a run belongs to: its values of the other axes that vary.
std::string curve_of(const std::vector<SweepAxis>& axes, const SweepRow& row, std::optional<std::size_t> plotted) {
  std::string name;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (i != plotted && axes[i].path != "seed" && axes[i].values.size() > 1)
      name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", axes[i].path, row.values[i]);
  return name.empty() ? "mean" : name;
}

}  // namespace

std::vector<SweepMeasure> sweep_measures(std::string_view plotted) {
  std::vector<SweepMeasure> measures = {
      {"bodies", "/bodies", "bodies"},
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
  if (plotted.starts_with('/')) measures.push_back({plotted, plotted, plotted});
  return measures;
}

SweepRow sweep_row(int number, const SweepRun& run, const nlohmann::json& summary, std::string_view plotted) {
  SweepRow row{.run = number,
               .values = run.values,
               .numbers = {},
               .reason = summary.value("reason", ""),
               .end_hash = summary.value("end_hash", "")};
  for (const SweepMeasure& measure : sweep_measures(plotted))
    row.numbers.push_back(number_at(summary, nlohmann::json::json_pointer(std::string(measure.key))));
  return row;
}

bool has_plotted(const nlohmann::json& summary, std::string_view plotted) {
  return !plotted.starts_with('/') ||
         number_at(summary, nlohmann::json::json_pointer(std::string(plotted))).has_value();
}

double SweepTable::Sample::standard_error() const {
  if (count < 2) return 0.0;
  return std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1)) / count);
}

SweepTable::SweepTable(const std::filesystem::path& file, std::vector<SweepAxis> axes, std::string_view plotted_measure)
    : file_(file),
      axes_(std::move(axes)),
      measures_(sweep_measures(plotted_measure)),
      along_(plotted_axis(axes_)),
      csv_(file_.path(), columns_of(axes_, measures_)) {
  measure_ = std::ranges::find(measures_, plotted_measure, &SweepMeasure::name) - measures_.begin();
}

void SweepTable::add(const SweepRow& row) {
  std::vector<std::string> cells = {fmt::format("{}", row.run)};
  cells.insert(cells.end(), row.values.begin(), row.values.end());
  cells.insert(cells.end(), {row.reason, row.end_hash});
  for (const std::optional<double>& number : row.numbers) cells.push_back(number ? fmt::format("{:.9g}", *number) : "");
  csv_.add(cells);
  if (curves_.size() > most_curves || measure_ >= row.numbers.size() || !row.numbers[measure_] ||
      row.reason != "finished")
    return;
  const double y = *row.numbers[measure_];
  Sample& sample = curves_[curve_of(axes_, row, along_)][along_ ? *number_of(row.values[*along_]) : 0.0];
  sample.sum += y;
  sample.squares += y * y;
  ++sample.count;
}

void SweepTable::finish() {
  csv_.flush();
  file_.finish();
}

/// With bars where a point has several seeds.
Series SweepTable::series_of(const std::string& name, const Points& points) {
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

std::string SweepTable::write_plot(const std::filesystem::path& file, const std::string& title) const {
  if (!along_) return "no key but seed has several values that are all numbers";
  if (curves_.empty()) return fmt::format("no finished run has a number {}", measures_[measure_].name);
  if (curves_.size() > most_curves) return fmt::format("it would have more than {} curves", most_curves);
  int most_seeds = 0;
  for (const auto& [name, points] : curves_)
    for (const auto& [x, sample] : points) most_seeds = std::max(most_seeds, sample.count);
  const std::string bars =
      most_seeds > 1 ? fmt::format(" (bars: standard error of the mean of {} seeds)", most_seeds) : "";
  Plot plot{.title = title,
            .x_label = axes_[*along_].path + bars,
            .y_label = std::string(measures_[measure_].label),
            .series = {}};
  for (const auto& [name, points] : curves_) plot.series.push_back(series_of(name, points));
  write_file(file, svg_of(plot));
  return {};
}

std::vector<std::string> SweepTable::lines() const {
  std::vector<std::string> lines;
  if (curves_.size() > most_curves) return lines;
  for (const auto& [name, points] : curves_) {
    for (const auto& [x, sample] : points) {
      if (sample.count < 2) continue;
      lines.push_back(fmt::format("{}{}: {} {:.4g} +- {:.2g}, {} runs", name,
                                  along_ ? fmt::format(", {} = {:g}", axes_[*along_].path, x) : "",
                                  measures_[measure_].label, sample.mean(), sample.standard_error(), sample.count));
    }
  }
  return lines;
}

}  // namespace talus
