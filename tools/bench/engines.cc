#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_report.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

constexpr int least_seeds = 8;  // fewer determine a shape badly

/// Groups of one scene, one per engine, with the same cases.
using EngineGroups = std::vector<BenchGroup>;

/// Difference of two ensembles' means in standard deviations of one run.
std::string difference(const Values& a, const Values& b, MeasureId id) {
  const MeasureId sd = id.with("_sd");
  return shown((b[id] - a[id]) / (std::hypot(a[sd], b[sd]) / std::sqrt(2.0)), 2);
}

/// Rows of the same scene and policy on all engines, and how far each is from the first.
Table side_by_side(const BenchRunner& runner, const std::vector<EngineGroups>& scenes) {
  constexpr std::array<MeasureId, 5> shape = {"centre", "r50", "r95", "peak", "angle_deg"};
  Table table{"", {{"scene"}, {"policy"}, {"engine"}, {"time [s]", true}, {"speed-up", true}}, {}};
  for (const MeasureId id : shape) {
    table.columns.push_back({std::string(id.info().heading), true});
    table.columns.push_back({"off / sd", true});
  }
  for (const EngineGroups& groups : scenes) {
    if (groups.empty()) continue;
    for (std::size_t i = 0; i < groups.front().cases.size(); ++i) {
      const Values first = runner.summary(groups.front().cases[i], groups.front().full());
      for (const BenchGroup& group : groups) {
        const Values values = runner.summary(group.cases[i], group.full());
        table.rows.push_back({key_of(group.cases[i]).scene, group.cases[i].policy, group.cases[i].backend,
                              shown(values, "seconds"), shown_with_range(values, "speed_up")});
        for (const MeasureId id : shape) {
          table.rows.back().push_back(shown_with_deviation(values, id));
          table.rows.back().push_back(&group == &groups.front() ? "" : difference(first, values, id));
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
  if (!own.quick) own.seeds = std::max(own.seeds, least_seeds);
  if (own.backends.empty()) own.backends = backends(2);
  const std::vector<std::string> names = {"drop_in_a_pile_2d",    "varying_drops_2d",  "multiple_piles_2d",
                                          "bunny_matrices_45_2d", "drop_in_a_line_2d", "rings_in_a_box_2d"};
  std::vector<EngineGroups> scenes;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(own, names, 2)) {
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
      "2D scenes over {} independent seeds; mean ± standard deviation of one run. \"off / sd\" is the distance from "
      "the first engine's mean in standard deviations of one run. Engines differ in contact margins and friction "
      "models, so not all distances are chance.",
      own.seeds));
  results.sections.push_back({"Side by side", {side_by_side(runner, scenes)}});
  std::ranges::move(common_sections(runner, groups), std::back_inserter(results.sections));
  write_results(runner, groups, results);
  print_text(text_of(side_by_side(runner, scenes)));
}

}  // namespace talus
