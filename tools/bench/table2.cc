#include <fmt/format.h>

#include <algorithm>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_report.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/paper_figures.h"

namespace talus {
namespace {

std::vector<BenchGroup> table2_groups(const BenchOptions& options, const std::string& scene,
                                      const std::string& backend) {
  const std::vector<std::string> settings = settings_of(options, scene);
  BenchGroup group{{{scene, backend, "full", settings}}};
  for (const paper::Threshold& threshold : paper::table_2) {
    BenchCase point{scene, backend, "paper", settings};
    point.settings.push_back(fmt::format("policy.tau={}", threshold.tau));
    point.curve = fmt::format("{}, {}", scene, backend);
    point.swept = threshold.tau;
    group.cases.push_back(point);
  }
  return {group};
}

std::string papers_speed_up(const CaseView& view) {
  const auto found = std::ranges::find(paper::table_2, view.bench_case.swept, &paper::Threshold::tau);
  return found == paper::table_2.end() ? "" : shown(found->speed_up);
}

Series papers_table_2() {
  Series series{"the paper's", {}, {}};
  series.style = SeriesStyle::line_and_points;
  for (const paper::Threshold& threshold : paper::table_2) {
    series.x.push_back(threshold.tau);
    series.y.push_back(threshold.speed_up);
  }
  std::ranges::reverse(series.x);
  std::ranges::reverse(series.y);
  return series;
}

}  // namespace

void bench_table2(const BenchOptions& options) {
  const auto over_tau = [](MeasureId y, const std::string& caption, const std::vector<Series>& more) {
    return CasePlot{.caption = caption,
                    .x_label = "sleeping threshold tau",
                    .x = [](const CaseView& view) { return view.bench_case.swept; },
                    .y = y,
                    .curve = curve_of_case,
                    .per_scene = false,
                    .more = more};
  };
  std::vector<CaseColumn> columns = name_columns();
  for (const CaseColumn& column :
       {plain("seconds"), with_range("speed_up"), plain("drift_mean_excess_D"), plain("relative"), plain("R")}) {
    columns.push_back(column);
  }
  columns.push_back({"paper: speed-up", papers_speed_up});
  run_report({.title = "Table 2 of the paper",
              .note = "Example 2 under the paper's policy over its sleeping threshold tau. A low tau lets bodies sleep "
                      "before they are at rest, which the drift after waking shows.",
              .scenes = {"varying_drops"},
              .groups = table2_groups,
              .columns = columns,
              .plots = {over_tau("speed_up", "Speed-up over the full simulation.", {papers_table_2()}),
                        over_tau("drift_mean_excess_D", "Drift of the sleeping bodies once all are woken.", {})}},
             options);
}

}  // namespace talus
