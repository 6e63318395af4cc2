#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/paper_figures.h"
#include "tools/bench/targets.h"
#include "tools/plot/plot.h"

namespace talus {

namespace {

std::string without_dimension(const std::string& scene) {
  return scene.size() > 3 && (scene.ends_with("_2d") || scene.ends_with("_3d")) ? scene.substr(0, scene.size() - 3)
                                                                                : scene;
}

const paper::Example* example_of(const std::string& scene) {
  const auto found = std::find_if(paper::table_1.begin(), paper::table_1.end(), [&](const paper::Example& example) {
    return example.scene == without_dimension(scene);
  });
  return found == paper::table_1.end() ? nullptr : &*found;
}

/// Cells of one case; the paper's own figures only beside its own policy.
std::vector<std::string> paper_row(const BenchRunner& runner, const BenchGroup& group, const BenchCase& each) {
  const BenchCase& full = group.cases.front();
  const Values of_full = runner.summary(full, full);
  const Values of_engine = runner.summary(group.cases[1], full);
  const Values values = runner.summary(each, full);
  const paper::Example* example = example_of(key_of(full).scene);
  const std::int64_t frames = std::visit([](const auto& scene) { return scene.run.frames; }, load(each));
  constexpr double percent = 100.0;
  std::vector<std::string> cells = {example != nullptr ? std::string(example->number) : "-",
                                    key_of(each).scene,
                                    each.backend,
                                    each.policy,
                                    std::to_string(frames),
                                    shown(value_of(values, "bodies"), 6),
                                    shown(value_of(of_full, "seconds")),
                                    shown(value_of(values, "seconds")),
                                    shown_with_range(values, "speed_up"),
                                    shown(value_of(of_engine, "seconds") / value_of(values, "seconds")),
                                    shown(value_of(of_full, "oracle_005")),
                                    shown(percent * value_of(values, "relative")),
                                    shown(percent * value_of(of_full, "relative_floor")),
                                    shown(value_of(values, "drift_mean_excess_D"))};
  if (example == nullptr || each.policy != "paper") {
    cells.insert(cells.end(), 4, "");
  } else {
    cells.insert(cells.end(),
                 {shown(example->full, 5), shown(example->piling, 5), shown(example->speed_up), shown(example->error)});
  }
  return cells;
}

Table paper_table_1(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  Table table{"", {{"example"}, {"scene"}, {"engine"}, {"policy"}}, {}};
  for (const char* name :
       {"frames", "objects", "full [s]", "this [s]", "speed-up", "over engine sleeping", "ceiling", "error e [%]",
        "its floor [%]", "drift beyond full / D", "paper: full [s]", "piling [s]", "speed-up", "error [%]"}) {
    table.columns.push_back({name, true});
  }
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      if (each.policy == "full" || is_yardstick(each)) continue;
      table.rows.push_back(paper_row(runner, group, each));
    }
  }
  return table;
}

/// Speed-up over what an oracle could save: a point a scene, a series a policy, and the line where both are equal.
Figure ceiling_figure(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  std::map<std::string, Series> by_policy;
  double least = 1.0;
  double most = 2.0;
  for (const BenchGroup& group : groups) {
    const double ceiling = value_of(runner.summary(group.cases.front(), group.cases.front()), "oracle_005");
    for (std::size_t i = 1; i < group.cases.size(); ++i) {
      const Values values = runner.summary(group.cases[i], group.cases.front());
      const double speed_up = value_of(values, "speed_up");
      if (is_yardstick(group.cases[i]) || !std::isfinite(ceiling) || !std::isfinite(speed_up)) continue;
      Series& series = by_policy[group.cases[i].policy];
      series.x.push_back(ceiling);
      series.y.push_back(speed_up);
      series.low.push_back(value_of(values, "speed_up_min"));
      series.high.push_back(value_of(values, "speed_up_max"));
      least = std::min({least, series.low.back(), ceiling});
      most = std::max({most, series.high.back(), ceiling});
    }
  }
  Plot plot{.title = "",
            .x_label = "oracle's ceiling (x = 0.05 D)",
            .y_label = "speed-up over full",
            .log_x = true,
            .log_y = true,
            .series = {}};
  for (auto& [policy, series] : by_policy) {
    series.name = policy;
    series.style = SeriesStyle::points;
    plot.series.push_back(series);
  }
  plot.series.push_back({"all that an oracle saves", {least, most}, {least, most}});
  return {svg_of(plot), "Each point a scene: what a policy gained against what could be gained."};
}

}  // namespace

void bench_table1(const BenchOptions& options) {
  std::vector<std::string> names;
  for (const char* first : {"drop_in_a_pile", "varying_drops", "multiple_piles", "drop_in_a_line"})
    names.emplace_back(first);
  for (const paper::Example& example : paper::table_1) {
    if (std::find(names.begin(), names.end(), example.scene) == names.end()) names.emplace_back(example.scene);
  }
  if (!options.quick)
    std::sort(names.begin(), names.end(),
              [](const std::string& a, const std::string& b) { return example_of(a) < example_of(b); });
  constexpr std::size_t quick_scenes = 4;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(options, names, quick_scenes)) {
    for (const std::string& backend : backends_of(options, scene)) {
      groups.push_back(policies_group(options, scene, backend));
      std::vector<BenchCase>& cases = groups.back().cases;
      if (options.reference) cases.push_back({scene, backend, shipped_policy, cases.front().settings});
    }
  }
  BenchRunner runner(options);
  runner.run(groups);
  BenchResults results{"Table 1 of the paper", {}, {}};
  results.notes.push_back(
      "The paper's examples, each under full simulation, the engine's own sleeping and the policies. The paper's own "
      "figures stand in the rows of its policy; its machine, engine and step are not known, so ratios may be compared, "
      "seconds not. Its error e is mean |m - m~| / |m|; what two equal simulations show of it when one is moved by a "
      "micrometre stands beside it as its floor.");
  results.sections.push_back({"The paper's table", {paper_table_1(runner, groups)}});
  if (options.errors) results.sections.push_back({"What could be gained", {ceiling_figure(runner, groups)}});
  if (options.errors) results.sections.push_back({"Targets", {targets_table(runner, groups)}});
  for (Section& section : common_sections(runner, groups)) results.sections.push_back(std::move(section));
  write_results(runner, groups, results);
  fmt::print("{}", text_of(paper_table_1(runner, groups)));
}

}  // namespace talus
