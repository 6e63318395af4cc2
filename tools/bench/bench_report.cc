#include "tools/bench/bench_report.h"

#include <iterator>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/output/output.h"

namespace talus {
namespace {

std::vector<CaseColumn> named(std::vector<CaseColumn> columns) {
  const std::vector<CaseColumn> names = name_columns();
  columns.insert(columns.begin(), names.begin(), names.end());
  return columns;
}

std::vector<CaseColumn> time_columns() {
  return named({with_range("seconds"), with_range("speed_up"), plain("hindsight_005"), plain("speed_up_pour"),
                plain("last_100_ms"), plain("speed_up_last_100"), plain("rule_ms"), plain("mean_awake"),
                plain("bodies"), plain("asleep_at_end"), plain("relative"), plain("drift_mean_excess_D"),
                plain("ks_z_p")});
}

std::vector<CaseColumn> motion_columns() {
  return named({with_floor("relative"), plain("left_out"), plain("absolute"), plain("floored"), with_floor("R"),
                plain("R_ceiling"), plain("R_skill"), with_floor("S"), plain("S_ceiling"), plain("S_skill"),
                with_floor("horizon_R_30"), with_floor("horizon_mean_30_D"), plain("diverges_at")});
}

std::vector<CaseColumn> shape_columns() {
  return named({plain("runs"), with_deviation("centre"), with_deviation("r50"), with_deviation("r95"),
                with_deviation("peak"), with_deviation("angle_deg"), with_floor("profile_rms_D"), with_floor("ks_z"),
                plain("ks_z_p"), with_floor("w1_z"), with_floor("ks_r"), plain("ks_r_p"), with_floor("w1_r")});
}

std::vector<CaseColumn> last_state_columns() {
  return named({plain("floating"), plain("penetration_p99_D"), plain("penetration_max_D"),
                with_deviation("drift_mean_D"), plain("drift_mean_excess_D"), plain("drift_far"),
                plain("drift_far_excess"), plain("wake_energy_mgD"), plain("settling_per_minute"),
                plain("work_skipped"), plain("stops_at"), plain("asleep_at")});
}

}  // namespace

std::vector<Section> common_sections(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  std::vector<Section> sections;
  sections.push_back(
      {"Time",
       {case_table(runner, groups, time_columns()),
        Paragraph{"Processor time of the simulation alone, without the first step; the policies alternate within a "
                  "round. Median, in brackets the smallest and largest of the rounds. Speed-ups are ratios within a "
                  "round. Hindsight is what a policy would save that knew which bodies of the full run move; a policy "
                  "may save more, since its own run moves less than the full one."}}});
  if (!runner.options().errors) return sections;
  std::vector<std::pair<Pass, std::string>> baselines = {{Pass::against_full, "full run at the same settings"}};
  if (runner.options().reference) baselines.emplace_back(Pass::against_reference, "converged reference");
  for (const auto& [pass, name] : baselines) {
    sections.push_back({"Motion against the " + name, {case_table(runner, groups, motion_columns(), pass)}});
    sections.push_back({"Shape against the " + name, {case_table(runner, groups, shape_columns(), pass)}});
    sections.push_back({"Last state against the " + name, {case_table(runner, groups, last_state_columns(), pass)}});
  }
  return sections;
}

void run_report(const BenchReport& report, const BenchOptions& options) {
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(options, report.scenes, report.quick_scenes))
    for (const std::string& backend : backends_of(options, scene))
      std::ranges::move(report.groups(options, scene, backend), std::back_inserter(groups));
  BenchRunner runner(options);
  runner.run(groups);
  BenchResults results{report.title, {report.note}, {}};
  const Table table = case_table(runner, groups, report.columns, Pass::against_full, report.in_table);
  results.sections.push_back({"In short", {table}});
  for (const CasePlot& plot : report.plots)
    for (Figure& figure : figures_of(runner, groups, plot))
      results.sections.front().blocks.emplace_back(std::move(figure));
  std::ranges::move(common_sections(runner, groups), std::back_inserter(results.sections));
  write_results(runner, groups, results);
  print_text(text_of(table));
}

}  // namespace talus
