#include <fmt/format.h>

#include <cmath>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/paper_figures.h"
#include "tools/plot/plot.h"

namespace talus {

namespace {

BenchGroup sweep(const BenchOptions& options, const std::string& scene, const std::string& backend) {
  const std::vector<std::string> settings = settings_of(options, scene);
  BenchGroup group{{{scene, backend, "full", settings}}};
  for (const paper::Threshold& threshold : paper::table_2) {
    std::vector<std::string> with_tau = settings;
    with_tau.push_back(fmt::format("policy.tau={}", threshold.tau));
    group.cases.push_back({scene, backend, "paper", with_tau});
  }
  return group;
}

Table paper_table_2(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  Table table{"", {{"scene"}, {"engine"}, {"what"}, {"none", true}}, {}};
  for (const paper::Threshold& threshold : paper::table_2)
    table.columns.push_back({fmt::format("{}", threshold.tau), true});
  const auto add = [&](const BenchGroup& group, const std::string& what, const std::string& name) {
    std::vector<std::string> row = {key_of(group.cases.front()).scene, group.cases.front().backend, what};
    for (const BenchCase& each : group.cases)
      row.push_back(shown(value_of(runner.summary(each, group.cases.front()), name)));
    table.rows.push_back(row);
  };
  std::vector<std::string> seconds = {"the paper's", "its own", "time [s]", shown(paper::table_2_full, 4)};
  std::vector<std::string> speed_ups = {"the paper's", "its own", "speed-up", "1"};
  for (const paper::Threshold& threshold : paper::table_2) {
    seconds.push_back(shown(threshold.seconds, 4));
    speed_ups.push_back(shown(threshold.speed_up));
  }
  table.rows = {seconds, speed_ups};
  for (const BenchGroup& group : groups) {
    add(group, "time [s]", "seconds");
    add(group, "speed-up", "speed_up");
    add(group, "drift beyond full / D", "drift_mean_excess_D");
    add(group, "paper's e", "relative");
    add(group, "R", "R");
  }
  return table;
}

Plot plot_of(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const std::string& name,
             const std::string& label) {
  Plot plot{.title = "", .x_label = "sleeping threshold tau", .y_label = label, .series = {}};
  for (const BenchGroup& group : groups) {
    Series series{key_of(group.cases.front()).scene + ", " + group.cases.front().backend, {}, {}};
    series.style = SeriesStyle::line_and_points;
    for (std::size_t i = 1; i < group.cases.size(); ++i) {
      const double value = value_of(runner.summary(group.cases[i], group.cases.front()), name);
      if (!std::isfinite(value)) continue;
      series.x.push_back(paper::table_2[i - 1].tau);
      series.y.push_back(value);
    }
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

void bench_table2(const BenchOptions& options) {
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(options, {"varying_drops"}, 1)) {
    for (const std::string& backend : backends_of(options, scene)) groups.push_back(sweep(options, scene, backend));
  }
  BenchRunner runner(options);
  runner.run(groups);
  BenchResults results{"Table 2 of the paper", {}, {}};
  results.notes.emplace_back(
      "Example 2 under the paper's policy over its sleeping threshold tau. A low tau lets bodies sleep before they are "
      "at rest: the drift after waking shows it.");
  results.sections.push_back({"The paper's table", {paper_table_2(runner, groups)}});
  Plot speed_up = plot_of(runner, groups, "speed_up", "speed-up over full");
  Series papers{"the paper's", {}, {}};
  papers.style = SeriesStyle::line_and_points;
  for (const paper::Threshold& threshold : paper::table_2) {
    papers.x.push_back(threshold.tau);
    papers.y.push_back(threshold.speed_up);
  }
  speed_up.series.push_back(papers);
  results.sections.push_back({"Speed-up", {Figure{svg_of(speed_up), "Speed-up over the full simulation."}}});
  if (options.errors) {
    const Plot drift = plot_of(runner, groups, "drift_mean_excess_D", "drift after waking, beyond full / D");
    if (!drift.series.empty()) {
      results.sections.push_back({"Drift", {Figure{svg_of(drift), "What the sleepers did when they were all woken."}}});
    }
  }
  for (Section& section : common_sections(runner, groups)) results.sections.push_back(std::move(section));
  write_results(runner, groups, results);
  fmt::print("{}", text_of(paper_table_2(runner, groups)));
}

}  // namespace talus
