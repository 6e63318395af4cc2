#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/plot/plot.h"

namespace talus {

namespace {

/// One curve: a policy while one parameter takes several values.
struct Curve {
  std::string name;
  std::string policy;
  std::vector<std::string> values;  // settings, one a point
};

std::vector<std::string> values(const std::string& path, const std::vector<std::string>& all) {
  std::vector<std::string> settings;
  for (const std::string& value : all) settings.push_back(path + "=" + value);
  return settings;
}

std::vector<Curve> curves(const BenchOptions& options) {
  const std::string iterations = "world.solver.velocity_iterations";
  const std::string rate = "world.steps_per_second";
  const auto some = [&](const std::vector<std::string>& few, const std::vector<std::string>& all) {
    return options.quick ? few : all;
  };
  std::vector<Curve> list = {{"full, iterations", "full", values(iterations, some({"5", "20"}, {"5", "20", "40"}))},
                             {"full, steps a second", "full", values(rate, some({"120"}, {"120", "240"}))}};
  for (const std::string& policy : options.policies.empty() ? known_policies() : options.policies) {
    if (policy == "full" || policy == "engine") continue;
    if (policy == "paper") {
      list.push_back(
          {"paper, tau", "paper", values("policy.tau", some({"0.3", "0.5"}, {"0.1", "0.2", "0.3", "0.4", "0.5"}))});
    }
    list.push_back({policy + ", iterations", policy, values(iterations, some({"10"}, {"5", "10", "20", "40"}))});
  }
  return list;
}

BenchCase case_of(const BenchCase& full, const Curve& curve, const std::string& value) {
  BenchCase point{full.scene, full.backend, curve.policy, full.settings};
  point.settings.push_back(value);
  return point;
}

BenchGroup group_of(const BenchOptions& options, const std::string& scene, const std::string& backend) {
  const std::vector<std::string> settings = settings_of(options, scene);
  BenchGroup group{{{scene, backend, "full", settings}, {scene, backend, "engine", settings}}};
  for (const Curve& curve : curves(options)) {
    for (const std::string& value : curve.values) group.cases.push_back(case_of(group.cases.front(), curve, value));
  }
  if (options.reference) group.cases.push_back({scene, backend, reference_policy, settings});
  return group;
}

/// By time, so that a line joins neighbours.
void sort_by_time(Series& series) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < series.x.size(); ++i) points.emplace_back(series.x[i], series.y[i]);
  std::sort(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i) std::tie(series.x[i], series.y[i]) = points[i];
}

/// Error over time, a series a curve.
Plot plot_of(const BenchRunner& runner, const BenchGroup& group, const std::string& error, const std::string& label) {
  const std::string against = runner.options().reference ? "reference" : "errors";
  Plot plot{.title = key_of(group.cases.front()).scene + ", " + group.cases.front().backend,
            .x_label = "time [s]",
            .y_label = label,
            .log_x = true,
            .series = {}};
  const auto add_point = [&](Series& series, const BenchCase& point) {
    const Values of_point = runner.summary(point, group.cases.front(), against);
    const double seconds = value_of(of_point, "seconds");
    const double value = value_of(of_point, error);
    if (!std::isfinite(seconds) || !std::isfinite(value)) return;
    series.x.push_back(seconds);
    series.y.push_back(value);
  };
  for (const Curve& curve : curves(runner.options())) {
    Series series{curve.name, {}, {}};
    series.style = SeriesStyle::line_and_points;
    if (curve.policy == "full") add_point(series, group.cases.front());
    for (const std::string& value : curve.values) add_point(series, case_of(group.cases.front(), curve, value));
    sort_by_time(series);
    constexpr std::size_t most_series = 7;
    if (!series.x.empty() && plot.series.size() < most_series) plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

void bench_pareto(const BenchOptions& options) {
  BenchOptions own = options;
  own.errors = true;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(own, {"drop_in_a_pile"}, 1)) {
    for (const std::string& backend : backends_of(own, scene)) groups.push_back(group_of(own, scene, backend));
  }
  BenchRunner runner(own);
  runner.run(groups);
  BenchResults results{"Time against error", {}, {}};
  results.notes.push_back(fmt::format(
      "Each curve a policy over one parameter; down and to the left is better. Errors are against the {}. {}",
      own.reference ? "converged reference" : "full run at default settings, which is itself the one to beat",
      own.reference ? "" : "With --reference they are against the converged simulation."));
  for (const BenchGroup& group : groups) {
    Section section{"Time against error: " + key_of(group.cases.front()).scene, {}};
    for (const auto& [name, label] :
         {std::pair("drift_mean_D", "drift after waking / D"),
          std::pair("profile_rms_D", "difference of height profiles (rms) / D"), std::pair("w1_r", "W1 of radii [m]"),
          std::pair("horizon_R_30", "R after 30 frames from a fork")}) {
      const Plot plot = plot_of(runner, group, name, label);
      if (!plot.series.empty()) section.blocks.emplace_back(Figure{svg_of(plot), label});
    }
    results.sections.push_back(section);
  }
  for (Section& section : common_sections(runner, groups)) results.sections.push_back(std::move(section));
  write_results(runner, groups, results);
}

}  // namespace talus
