#include <fmt/format.h>

#include <initializer_list>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_report.h"
#include "tools/bench/benchmarks.h"

namespace talus {
namespace {

/// One curve: a policy while one setting takes several values.
struct Sweep {
  std::string curve;
  std::string policy;
  std::string path;
  std::vector<double> values;
};

std::vector<Sweep> pareto_sweeps(const BenchOptions& options) {
  const std::string iterations = "world.solver.velocity_iterations";
  const auto some = [&](const std::vector<double>& few, const std::vector<double>& all) {
    return options.quick ? few : all;
  };
  std::vector<Sweep> sweeps = {{"full, iterations", "full", iterations, some({5, 20}, {5, 20, 40})},
                               {"full, steps a second", "full", "world.steps_per_second", some({120}, {120, 240})}};
  for (const std::string& policy : policies_of(options)) {
    if (policy == "paper")
      sweeps.push_back({"paper, tau", "paper", "policy.tau", some({0.3, 0.5}, {0.1, 0.2, 0.3, 0.4, 0.5})});
    if (policy == "adaptive") {
      const std::string tolerance = "policy.adaptive.tolerance";
      sweeps.push_back({"adaptive, tolerance", "adaptive", tolerance, some({0.05, 0.2}, {0.01, 0.02, 0.05, 0.1, 0.2})});
      sweeps.push_back({"adaptive, no checks", "adaptive", tolerance, {0.0}});
    }
  }
  return sweeps;
}

std::vector<BenchGroup> pareto_groups(const BenchOptions& options, const std::string& scene,
                                      const std::string& backend) {
  const std::vector<std::string> settings = settings_of(options, scene);
  BenchGroup group{{{scene, backend, "full", settings, "full"}, {scene, backend, "engine", settings, "engine"}}};
  for (const Sweep& sweep : pareto_sweeps(options)) {
    for (const double value : sweep.values) {
      BenchCase point{scene, backend, sweep.policy, settings, sweep.curve, value};
      point.settings.push_back(fmt::format("{}={}", sweep.path, value));
      group.cases.push_back(point);
    }
  }
  if (options.reference) group.cases.push_back({scene, backend, reference_policy, settings});
  return {group};
}

}  // namespace

void bench_pareto(const BenchOptions& options) {
  BenchOptions own = options;
  own.errors = true;
  const Pass pass = own.reference ? Pass::against_reference : Pass::against_full;
  std::vector<CaseColumn> columns = name_columns();
  std::vector<CasePlot> plots;
  columns.push_back(plain("seconds"));
  constexpr MeasureId drift = "drift_mean_D";
  for (const MeasureId id : std::initializer_list<MeasureId>{drift, "profile_rms_D", "w1_r", "horizon_R_30"}) {
    columns.push_back(plain(id));
    plots.push_back({.caption = std::string(id.info().meaning),
                     .x_label = "processor time of the run [s]",
                     .x = measured("seconds"),
                     .y = id,
                     .log_x = true,
                     .log_y = id.index() == drift.index(),  // three decades; the others are 0 for the run itself
                     .pass = pass,
                     .curve = curve_of_case,
                     .in_order_of_cases = true});
  }
  run_report(
      {.title = "Time against error",
       .note = fmt::format("Each curve is a policy over one parameter; down and to the left is better. Errors are "
                           "against the {}.",
                           own.reference ? "converged reference" : "full run at the scene's settings"),
       .scenes = {"drop_in_a_pile"},
       .groups = pareto_groups,
       .columns = columns,
       .plots = plots},
      own);
}

}  // namespace talus
