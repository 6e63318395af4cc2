#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "tools/bench/bench_results.h"

namespace talus {

namespace {

/// A column of a table: its name and what it shows of a case.
struct ShownColumn {
  std::string name;
  std::function<std::string(const Values&)> cell;
};

ShownColumn number(const std::string& name, const std::string& value, int digits = 3) {
  return {name, [=](const Values& values) { return shown(value_of(values, value), digits); }};
}

ShownColumn pair_of(const std::string& name, const std::string& first, const std::string& second) {
  return {name, [=](const Values& values) {
            return shown(value_of(values, first)) + " / " + shown(value_of(values, second));
          }};
}

ShownColumn with_deviation(const std::string& name, const std::string& value) {
  return {name, [=](const Values& values) {
            const double mean = value_of(values, value);
            return std::isnan(mean) ? "-" : shown(mean) + " ± " + shown(value_of(values, value + "_sd"), 2);
          }};
}

Table table_of(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const std::string& against,
               const std::vector<ShownColumn>& columns) {
  Table table{"", {{"scene"}, {"engine"}, {"policy"}}, {}};
  for (const ShownColumn& column : columns) table.columns.push_back({column.name, true});
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      const Values values = runner.summary(each, group.cases.front(), against);
      if (values.empty()) continue;
      table.rows.push_back({key_of(each).scene, each.backend, label_of(group, each)});
      for (const ShownColumn& column : columns) table.rows.back().push_back(column.cell(values));
    }
  }
  return table;
}

std::vector<ShownColumn> time_columns() {
  return {
      {"time [s]", [](const Values& values) { return shown_with_range(values, "seconds"); }},
      {"speed-up over full", [](const Values& values) { return shown_with_range(values, "speed_up"); }},
      number("oracle's ceiling", "oracle_005"),
      {"of the ceiling",
       [](const Values& values) { return shown(value_of(values, "speed_up") / value_of(values, "oracle_005"), 2); }},
      number("while pouring", "speed_up_pour"),
      number("last 100 steps [ms]", "last_100_ms"),
      number("there", "speed_up_last_100"),
      number("rule [ms/step]", "rule_ms"),
      number("mean awake", "mean_awake", 4),
      number("bodies", "bodies", 6),
      number("asleep at end", "asleep_at_end", 6),
      number("paper's e", "relative"),
      number("drift beyond baseline / D", "drift_mean_excess_D"),
      number("KS(z) p", "ks_z_p", 2)};
}

std::vector<ShownColumn> motion_columns() {
  return {pair_of("paper's e / floor", "relative", "relative_floor"),
          number("left out", "left_out", 2),
          number("E / m0", "absolute"),
          number("floored", "floored"),
          number("R", "R"),
          pair_of("R floor / ceiling", "R_floor", "R_ceiling"),
          number("R skill", "R_skill", 2),
          number("S", "S"),
          pair_of("S floor / ceiling", "S_floor", "S_ceiling"),
          number("S skill", "S_skill", 2),
          pair_of("R after 30 frames / floor", "horizon_R_30", "horizon_R_30_floor"),
          number("twins part at [s]", "diverges_at")};
}

std::vector<ShownColumn> shape_columns() {
  return {number("runs", "twins"),
          with_deviation("centre [m]", "centre"),
          with_deviation("r50 [m]", "r50"),
          with_deviation("r95 [m]", "r95"),
          with_deviation("peak [m]", "peak"),
          with_deviation("angle [°]", "angle_deg"),
          pair_of("profile rms / D, floor", "profile_rms_D", "profile_rms_D_floor"),
          pair_of("KS(z) / floor", "ks_z", "ks_z_floor"),
          number("p", "ks_z_p", 2),
          pair_of("W1(z) [m] / floor", "w1_z", "w1_z_floor"),
          pair_of("KS(r) / floor", "ks_r", "ks_r_floor"),
          number("p", "ks_r_p", 2),
          pair_of("W1(r) [m] / floor", "w1_r", "w1_r_floor")};
}

std::vector<ShownColumn> state_columns() {
  return {number("floating", "floating"),
          number("penetration 99 % / D", "penetration_p99_D", 2),
          number("max / D", "penetration_max_D", 2),
          with_deviation("drift after waking / D", "drift_mean_D"),
          number("beyond baseline", "drift_mean_excess_D"),
          number("share above 0.1 D", "drift_far", 2),
          number("beyond baseline", "drift_far_excess", 2),
          number("wake energy / mgD", "wake_energy_mgD", 2),
          number("settling per minute", "settling_per_minute", 2),
          number("work skipped", "work_skipped"),
          number("last body stops [s]", "stops_at"),
          number("all asleep from [s]", "asleep_at")};
}

}  // namespace

std::vector<Section> common_sections(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  std::vector<Section> sections;
  sections.push_back(
      {"Time, and what it was paid with",
       {table_of(runner, groups, "errors", time_columns()),
        Paragraph{
            "Processor time of the simulation alone, the first step left out; policies alternate within a round; "
            "median, in brackets smallest and largest of the rounds. Speed-ups are ratios within a round. The "
            "oracle's ceiling is what a simulation could save that moves only bodies about to move by 0.05 D."}}});
  if (!runner.options().errors) return sections;
  std::vector<std::pair<std::string, std::string>> baselines = {{"errors", "full run at the same settings"}};
  if (runner.options().reference) baselines.emplace_back("reference", "converged reference");
  for (const auto& [against, name] : baselines) {
    sections.push_back({"Motion against the " + name, {table_of(runner, groups, against, motion_columns())}});
    sections.push_back({"Shape against the " + name, {table_of(runner, groups, against, shape_columns())}});
    sections.push_back({"Last state against the " + name, {table_of(runner, groups, against, state_columns())}});
  }
  return sections;
}

}  // namespace talus
