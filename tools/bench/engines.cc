#include <fmt/format.h>

#include <cmath>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/run/backends.h"

namespace talus {

namespace {

constexpr int least_twins = 8;  // fewer say little about a shape

/// Difference of two ensembles' means over the deviation of one run.
std::string apart(const Values& a, const Values& b, const std::string& name) {
  const double deviation = std::hypot(value_of(a, name + "_sd"), value_of(b, name + "_sd")) / std::sqrt(2.0);
  return shown((value_of(b, name) - value_of(a, name)) / deviation, 2);
}

std::string with_deviation(const Values& values, const std::string& name) {
  return shown(value_of(values, name)) + " ± " + shown(value_of(values, name + "_sd"), 2);
}

/// Rows of the same scene and policy on all engines, and how far each is from the first.
Table side_by_side(const BenchRunner& runner, const std::vector<std::vector<BenchGroup>>& scenes) {
  const std::vector<std::pair<std::string, std::string>> shape = {{"centre", "centre [m]"},
                                                                  {"r50", "r50 [m]"},
                                                                  {"r95", "r95 [m]"},
                                                                  {"peak", "peak [m]"},
                                                                  {"angle_deg", "angle [°]"}};
  Table table{"", {{"scene"}, {"policy"}, {"engine"}, {"time [s]", true}, {"speed-up", true}}, {}};
  for (const auto& [name, title] : shape) {
    table.columns.push_back({title, true});
    table.columns.push_back({"off / sd", true});
  }
  for (const std::vector<BenchGroup>& groups : scenes) {
    if (groups.empty()) continue;
    for (std::size_t i = 0; i < groups.front().cases.size(); ++i) {
      const Values first = runner.summary(groups.front().cases[i], groups.front().cases.front());
      for (const BenchGroup& group : groups) {
        const Values values = runner.summary(group.cases[i], group.cases.front());
        table.rows.push_back({key_of(group.cases[i]).scene, group.cases[i].policy, group.cases[i].backend,
                              shown(value_of(values, "seconds")), shown_with_range(values, "speed_up")});
        for (const auto& [name, title] : shape) {
          table.rows.back().push_back(with_deviation(values, name));
          table.rows.back().push_back(&group == &groups.front() ? "" : apart(first, values, name));
        }
      }
    }
  }
  return table;
}

}  // namespace

void bench_engines(const BenchOptions& options) {
  BenchOptions own = options;
  own.errors = true;
  own.reference = false;
  if (!own.quick) own.twins = std::max(own.twins, least_twins);
  if (own.backends.empty()) own.backends = backends(2);
  std::vector<std::vector<BenchGroup>> scenes;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(own,
                                            {"drop_in_a_pile_2d", "varying_drops_2d", "multiple_piles_2d",
                                             "bunny_matrices_45_2d", "drop_in_a_line_2d", "rings_in_a_box_2d"},
                                            2)) {
    if (dimension_of(scene) != 2) continue;
    scenes.emplace_back();
    for (const std::string& backend : backends_of(own, scene)) {
      scenes.back().push_back(policies_group(own, scene, backend));
      groups.push_back(scenes.back().back());
    }
  }
  BenchRunner runner(own);
  runner.run(groups);
  BenchResults results{"The same scenes on every engine", {}, {}};
  results.notes.push_back(fmt::format(
      "Scenes in a plane, {} runs a side whose spout is moved by a micrometre each; mean ± standard deviation of one "
      "run. "
      "\"off / sd\" is the distance from the first engine's mean in standard deviations of one run: engines differ in "
      "contact margins and friction models, so not all distances are chance.",
      own.twins));
  results.sections.push_back({"Side by side", {side_by_side(runner, scenes)}});
  for (Section& section : common_sections(runner, groups)) results.sections.push_back(std::move(section));
  write_results(runner, groups, results);
  fmt::print("{}", text_of(side_by_side(runner, scenes)));
}

}  // namespace talus
