#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/measure/compare.h"
#include "common/measure/ensemble.h"
#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_report.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/frame_series.h"
#include "tools/plot/plot.h"

namespace talus {
namespace {

/// Means over about a second each, so that a curve can be seen.
Series smoothed(const std::string& name, const std::vector<double>& values, double frame_time, double scale) {
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(1.0 / frame_time)));
  Series series{name, {}, {}};
  for (std::size_t first = 0; first + window <= values.size(); first += window) {
    std::vector<double> part(values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(first + window));
    std::erase_if(part, [](double value) { return !std::isfinite(value); });
    if (part.empty()) continue;
    series.x.push_back((static_cast<double>(first) + 0.5 * static_cast<double>(window)) * frame_time);
    series.y.push_back(scale * mean(part));
  }
  return series;
}

/// What is zero has no place on a logarithmic axis.
void leave_out_zeros(Series& series) {
  Series above = series;
  above.x.clear();
  above.y.clear();
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    if (series.y[i] <= 0.0) continue;
    above.x.push_back(series.x[i]);
    above.y.push_back(series.y[i]);
  }
  series = above;
}

void add(Section& section, Plot plot, const std::string& caption) {
  if (plot.log_y) std::for_each(plot.series.begin(), plot.series.end(), leave_out_zeros);
  std::erase_if(plot.series, [](const Series& series) { return series.x.empty(); });
  if (!plot.series.empty()) section.blocks.emplace_back(Figure{svg_of(plot), caption});
}

Section section_of(const BenchRunner& runner, const BenchGroup& group) {
  const BenchOptions& options = runner.options();
  Section section{key_of(group.cases.front()).scene + ", " + group.cases.front().backend, {}};
  Plot time{.title = "", .x_label = "simulated time [s]", .y_label = "time per frame [ms]", .series = {}};
  Plot relative{
      .title = "", .x_label = "simulated time [s]", .y_label = "paper's relative error e", .log_y = true, .series = {}};
  Plot absolute{.title = "", .x_label = "simulated time [s]", .y_label = "paper's absolute error E / m0", .series = {}};
  Plot ratio{.title = "", .x_label = "simulated time [s]", .y_label = "R", .series = {}};
  for (const BenchCase& each : group.cases) {
    const FrameSeries series = frame_series(options.out, each, group.cases.front(), options.rounds);
    constexpr double milliseconds = 1e3;
    time.series.push_back(smoothed(each.policy, series.seconds, series.frame_time, milliseconds));
    const std::string name = each.policy == "full" ? "full, perturbed by a micrometre" : each.policy;
    relative.series.push_back(smoothed(name, series.relative, series.frame_time, 1.0));
    absolute.series.push_back(smoothed(name, series.absolute, series.frame_time, 1.0));
    ratio.series.push_back(smoothed(name, series.ratio, series.frame_time, 1.0));
  }
  add(section, time, "Processor time per frame of output, means over a second.");
  add(section, relative, "The paper's relative error against the full run; \"full\" shows what a micrometre does.");
  add(section, absolute, "The paper's absolute error in units of one frame of free fall.");
  add(section, ratio, "Ratio of sums R: bounded, and not led astray by bodies at rest.");
  return section;
}

}  // namespace

void bench_figures(const BenchOptions& options) {
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(options, {"drop_in_a_line", "rings_in_a_box"}, 1)) {
    for (const std::string& backend : backends_of(options, scene)) {
      groups.push_back(policies_group(options, scene, backend));
      std::erase_if(groups.back().cases, [](const BenchCase& each) { return each.policy == reference_policy; });
    }
  }
  BenchRunner runner(options);
  runner.run(groups);
  BenchResults results{"Figures 5 and 6 of the paper", {}, {}};
  results.notes.emplace_back(
      "Time and error per frame of example 5 (drop in a line) and example 6 (rings in a box), as the paper's Figures 5 "
      "and 6 show them. Times per frame are medians over the rounds.");
  for (const BenchGroup& group : groups) results.sections.push_back(section_of(runner, group));
  for (Section& section : common_sections(runner, groups)) results.sections.push_back(std::move(section));
  write_results(runner, groups, results);
}

}  // namespace talus
