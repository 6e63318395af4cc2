#include "tools/bench/bench_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/text/file.h"
#include "tools/bench/bench_plan.h"
#include "tools/output/csv.h"
#include "tools/output/table.h"
#include "tools/plot/plot.h"

namespace talus {
namespace {

/// The rows of a case, one for each seed.
struct BenchGroup {
  const BenchCase* first;
  std::vector<const BenchRow*> rows;

  MeanWithError of(double BenchNumbers::*number) const {
    std::vector<double> all;
    for (const BenchRow* row : rows) all.push_back(row->numbers.*number);
    return mean_with_error(all);
  }
  /// With the scatter of the reference.
  MeanWithError of(double BenchNumbers::*number, double BenchNumbers::*reference_error) const {
    const MeanWithError own = of(number);
    return {own.mean, std::hypot(own.error, of(reference_error).mean)};
  }
};

std::vector<BenchGroup> groups_of(const std::vector<BenchRow>& rows) {
  std::vector<BenchGroup> groups;
  for (const BenchRow& row : rows) {
    const auto same = [&](const BenchGroup& group) {
      return group.first->scene == row.run.scene && group.first->backend == row.run.backend &&
             group.first->policy == row.run.policy && group.first->settings == row.run.settings;
    };
    auto group = std::ranges::find_if(groups, same);
    if (group == groups.end()) group = groups.insert(groups.end(), {&row.run, {}});
    if (row.failure.empty()) group->rows.push_back(&row);
  }
  return groups;
}

/// Whether two runs differ in policy, its settings and seed at most.
bool in_one_set(const BenchCase& a, const BenchCase& b) {
  return a.scene == b.scene && a.backend == b.backend && settings_of_world(a.settings) == settings_of_world(b.settings);
}

/// Sets an error of shape in per cent of the reference's mean.
void compare_shape(BenchNumbers& numbers, const std::vector<double>& reference, double BenchNumbers::*number,
                   double BenchNumbers::*error, double BenchNumbers::*standard_error) {
  const MeanWithError of_reference = mean_with_error(reference);
  if (!(of_reference.mean > 0.0)) return;  // nor without a reference
  numbers.*error = 100.0 * (numbers.*number / of_reference.mean - 1.0);
  numbers.*standard_error = 100.0 * of_reference.error / of_reference.mean;
}

std::string cell_of(double number) { return std::isfinite(number) ? fmt::format("{:.9g}", number) : ""; }

std::vector<std::string> key_cells(const BenchCase& run) {
  return {run.scene_name(), run.backend, run.policy, fmt::format("{}", fmt::join(run.settings, " ")),
          fmt::format("{}", run.seed)};
}

/// A number of the paper, as it stands there.
std::string published(double number) { return std::isfinite(number) ? fmt::format("{:g}", number) : "-"; }

using Cells = std::vector<std::string>;

Cells summary_cells(const BenchGroup& group, std::string_view preset) {
  const PapersNumbers papers =
      preset.empty() ? PapersNumbers{} : papers_numbers(*group.first, preset).value_or(PapersNumbers{});
  const MeanWithError motion = group.of(&BenchNumbers::motion_error);
  return {group.first->scene_name(),
          group.first->backend,
          group.first->policy,
          fmt::format("{}", fmt::join(group.first->settings, " ")),
          fmt::format("{}", group.rows.size()),
          mean_text(group.of(&BenchNumbers::seconds)),
          mean_text(group.of(&BenchNumbers::speed_up)),
          mean_text(group.of(&BenchNumbers::mean_awake)),
          mean_text(group.of(&BenchNumbers::centre_error, &BenchNumbers::centre_error_se)),
          mean_text(group.of(&BenchNumbers::r50_error, &BenchNumbers::r50_error_se)),
          mean_text(group.of(&BenchNumbers::drift)),
          mean_text({100.0 * motion.mean, 100.0 * motion.error}),
          published(papers.speed_up),
          published(papers.error)};
}

/// Leaves out the columns in which no row has a value.
void drop_empty_columns(Table& table) {
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    if (!std::ranges::all_of(table.rows, [&](const Cells& row) { return row[i] == "-" || row[i].empty(); })) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    table.columns.erase(table.columns.begin() + at);
    for (Cells& row : table.rows) row.erase(row.begin() + at);
  }
}

constexpr std::size_t most_curves = 7;  // colours that people of any colour vision can distinguish

Series& curve_of(Plot& plot, const std::string& name, SeriesStyle style) {
  const auto found = std::ranges::find(plot.series, name, &Series::name);
  if (found != plot.series.end()) return *found;
  return plot.series.emplace_back(Series{.name = name, .x = {}, .y = {}, .style = style});
}

/// The time of a run against the error of the centre's height.
Plot error_plot(const std::vector<BenchGroup>& groups) {
  Plot plot{.title = "",
            .x_label = "processor time of a run [s]",
            .y_label = "centre of mass off the reference [%]",
            .log_x = true,
            .series = {}};
  for (const BenchGroup& group : groups) {
    const MeanWithError time = group.of(&BenchNumbers::seconds);
    const MeanWithError error = group.of(&BenchNumbers::centre_error, &BenchNumbers::centre_error_se);
    if (!(time.mean > 0.0) || !std::isfinite(error.mean)) continue;
    Series& curve = curve_of(plot, group.first->policy, SeriesStyle::line_and_points);
    curve.x.push_back(time.mean);
    curve.y.push_back(error.mean);
    const double half_bar = std::isfinite(error.error) ? error.error : 0.0;
    curve.low.push_back(error.mean - half_bar);
    curve.high.push_back(error.mean + half_bar);
  }
  return plot;
}

/// Means over a second each, so that a curve can be seen; of the first seed.
Plot frame_plot(const std::vector<BenchGroup>& groups, const std::string& label, double BenchFrame::*number,
                double scale) {
  const bool logarithmic = number == &BenchFrame::motion_error;
  Plot plot{.title = "", .x_label = "simulated time [s]", .y_label = label, .log_y = logarithmic, .series = {}};
  for (const BenchGroup& group : groups) {
    if (group.rows.empty() || group.rows.front()->frames.empty()) continue;
    Series& curve = curve_of(plot, group.first->policy, SeriesStyle::line);
    std::vector<double> part;
    double second = 0.0;
    for (const BenchFrame& frame : group.rows.front()->frames) {
      if (frame.time >= second + 1.0) {
        const double middle = mean(part);
        if (!part.empty() && (!plot.log_y || middle > 0.0)) {
          curve.x.push_back(second + 0.5);
          curve.y.push_back(scale * middle);
        }
        second = std::floor(frame.time);
        part.clear();
      }
      if (std::isfinite(frame.*number)) part.push_back(frame.*number);
    }
  }
  return plot;
}

}  // namespace

std::string mean_text(const MeanWithError& number) {
  if (!std::isfinite(number.mean)) return "-";
  const double finest = number.error > 0.0 ? number.error : std::abs(number.mean);
  const int digits = finest > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(finest))), 0, 6) : 0;
  if (!(number.error > 0.0)) return fmt::format("{:.{}f}", number.mean, digits);
  return fmt::format("{:.{}f} ± {:.{}f}", number.mean, digits, number.error, digits);
}

void compare_rows(std::vector<BenchRow>& rows) {
  for (BenchRow& row : rows) {
    std::vector<double> centres;
    std::vector<double> radii;
    for (const BenchRow& other : rows) {
      if (!other.failure.empty() || !in_one_set(row.run, other.run)) continue;
      if (other.run.policy == "full" && other.run.seed == row.run.seed)
        row.numbers.speed_up = other.numbers.seconds / row.numbers.seconds;
      if (other.run.policy != reference_policy) continue;
      centres.push_back(other.numbers.centre_height);
      radii.push_back(other.numbers.r50);
    }
    if (!row.failure.empty() || row.run.policy == reference_policy) continue;
    compare_shape(row.numbers, centres, &BenchNumbers::centre_height, &BenchNumbers::centre_error,
                  &BenchNumbers::centre_error_se);
    compare_shape(row.numbers, radii, &BenchNumbers::r50, &BenchNumbers::r50_error, &BenchNumbers::r50_error_se);
  }
}

void write_bench_csv(const std::filesystem::path& file, const std::vector<BenchRow>& rows) {
  std::string text = "scene,backend,policy,settings,seed";
  for (const BenchColumn& column : bench_columns) text += fmt::format(",{}", column.name);
  text += ",end_hash,failure\n";
  for (const BenchRow& row : rows) {
    Cells cells = key_cells(row.run);
    for (const BenchColumn& column : bench_columns) cells.push_back(cell_of(row.numbers.*column.number));
    cells.insert(cells.end(), {row.end_hash, row.failure});
    text += csv_line(cells);
  }
  write_file(file, text);
}

void write_frames_csv(const std::filesystem::path& file, const std::vector<BenchRow>& rows) {
  std::string text;
  for (const BenchRow& row : rows) {
    for (const BenchFrame& frame : row.frames) {
      Cells cells = key_cells(row.run);
      for (const double number : {frame.time, frame.seconds, frame.motion_error}) cells.push_back(cell_of(number));
      text += csv_line(cells);
    }
  }
  if (!text.empty()) write_file(file, "scene,backend,policy,settings,seed,time_s,seconds,motion_error\n" + text);
}

std::string bench_summary(const std::vector<BenchRow>& rows, std::string_view preset) {
  Table table = {.caption = "",
                 .columns = {{"scene"},
                             {"engine"},
                             {"policy"},
                             {"settings"},
                             {"runs", true},
                             {"time [s]", true},
                             {"speed-up", true},
                             {"awake", true},
                             {"centre [%]", true},
                             {"r50 [%]", true},
                             {"drift [D]", true},
                             {"motion error [%]", true},
                             {"paper: speed-up", true},
                             {"error [%]", true}},
                 .rows = {}};
  for (const BenchGroup& group : groups_of(rows)) table.rows.push_back(summary_cells(group, preset));
  drop_empty_columns(table);
  return text_of(table);
}

std::vector<std::string> write_bench_plots(const std::filesystem::path& folder, const std::vector<BenchRow>& rows) {
  std::vector<std::string> names;
  std::vector<BenchGroup> groups = groups_of(rows);
  while (!groups.empty()) {
    const BenchCase& first = *groups.front().first;
    const auto others = std::ranges::stable_partition(groups, [&](const BenchGroup& group) {
      return group.first->scene == first.scene && group.first->backend == first.backend;
    });
    const std::vector<BenchGroup> one(groups.begin(), others.begin());
    const auto write = [&](const std::string& kind, Plot plot) {
      std::erase_if(plot.series, [](const Series& series) { return series.x.empty(); });
      if (plot.series.empty() || plot.series.size() > most_curves) return;
      plot.title = first.scene_name() + ", " + first.backend;
      names.push_back(fmt::format("{}-{}-{}.svg", kind, first.scene_name(), first.backend));
      write_file(folder / names.back(), svg_of(plot));
    };
    write("error", error_plot(one));
    write("frame_time", frame_plot(one, "time per frame [ms]", &BenchFrame::seconds, 1e3));
    write("frame_error", frame_plot(one, "the paper's relative error", &BenchFrame::motion_error, 1.0));
    groups.erase(groups.begin(), others.begin());
  }
  return names;
}

}  // namespace talus
