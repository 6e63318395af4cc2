#include <algorithm>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_report.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/paper_figures.h"

namespace talus {
namespace {

const paper::Example* example_of(const CaseView& view) {
  const std::string scene = key_of(view.bench_case).scene;
  const auto found = std::ranges::find_if(paper::table_1, [&](const paper::Example& example) {
    return scene == std::string(example.scene) + "_2d" || scene == std::string(example.scene) + "_3d";
  });
  return found == paper::table_1.end() ? nullptr : &*found;
}

/// A number of the paper, in the rows of its own policy.
CaseColumn of_the_paper(const std::string& heading, double paper::Example::*number) {
  return {heading, [=](const CaseView& view) {
            const paper::Example* example = example_of(view);
            return example == nullptr || view.bench_case.policy != "paper" ? "" : shown(example->*number, 5);
          }};
}

std::string example_number(const CaseView& view) {
  const paper::Example* example = example_of(view);
  return example == nullptr ? "-" : std::string(example->number);
}

std::string speed_up_over_engine(const CaseView& view) {
  const BenchCase* engine = view.group.find("engine");
  return engine == nullptr ? "-" : shown(view.of(*engine)["seconds"] / view.values["seconds"]);
}

std::vector<CaseColumn> table1_columns() {
  std::vector<CaseColumn> columns = {{"example", example_number, false}};
  for (const CaseColumn& column : name_columns()) columns.push_back(column);
  columns.push_back(plain("bodies"));
  columns.push_back({"full [s]", [](const CaseView& view) { return shown(view.of(view.group.full()), "seconds"); }});
  columns.push_back(plain("seconds"));
  columns.push_back(with_range("speed_up"));
  columns.push_back({"over engine sleeping", speed_up_over_engine});
  columns.push_back(hindsight_column());
  columns.push_back(with_floor("relative"));
  columns.push_back(plain("drift_mean_excess_D"));
  columns.push_back(with_deviation("centre"));
  columns.push_back(of_the_paper("paper: full [s]", &paper::Example::full));
  columns.push_back(of_the_paper("piling [s]", &paper::Example::piling));
  columns.push_back(of_the_paper("speed-up", &paper::Example::speed_up));
  columns.push_back(of_the_paper("error [%]", &paper::Example::error));
  return columns;
}

/// Scenes of Table 1; four that differ most come first, for --quick.
std::vector<std::string> table1_scenes() {
  std::vector<std::string> names = {"drop_in_a_pile", "varying_drops", "multiple_piles", "drop_in_a_line"};
  for (const paper::Example& example : paper::table_1)
    if (std::ranges::find(names, example.scene) == names.end()) names.emplace_back(example.scene);
  return names;
}

std::vector<BenchGroup> table1_groups(const BenchOptions& options, const std::string& scene,
                                      const std::string& backend) {
  BenchGroup group = policies_group(options, scene, backend);
  if (options.reference) group.cases.push_back({scene, backend, engine_default_policy, group.full().settings});
  return {group};
}

}  // namespace

void bench_table1(const BenchOptions& options) {
  const CasePlot over_hindsight = {
      .caption = "Each point a scene: speed-up of a policy over hindsight.",
      .x_label = "hindsight (bodies over bodies that move by 0.05 D)",
      .x = [](const CaseView& view) { return view.of(view.group.full())["hindsight_005"]; },
      .y = "speed_up",
      .log_x = true,
      .log_y = true,
      .bars = Bars::rounds,
      .curve = sleeping_policy_of,
      .per_scene = false,
      .more = {{"as much as hindsight", {1.0, 20.0}, {1.0, 20.0}}}};
  run_report(
      {.title = "Table 1 of the paper",
       .note = "The paper's examples under full simulation, the engine's own sleeping and the policies. The paper's "
               "figures stand in the rows of its policy; its machine, engine and step are not known, so ratios may "
               "be compared and seconds may not. Its error e is mean |m - m~| / |m|; its floor is what a shift of "
               "the source by a micrometre gives.",
       .scenes = table1_scenes(),
       .quick_scenes = 4,
       .groups = table1_groups,
       .columns = table1_columns(),
       .in_table = sleeps,
       .plots = {over_hindsight}},
      options);
}

}  // namespace talus
