#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "tools/bench/bench_report.h"
#include "tools/bench/benchmarks.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Solver settings of the full simulation.
struct Solver {
  int steps_per_second;
  int velocity_iterations;
  int position_iterations;  // Box2D only
  int friction_directions;  // Bullet in 3D only
};

struct SolverSweep {
  std::string curve;
  std::vector<Solver> points;
};

/// The finest first: the baseline of all others.
std::vector<SolverSweep> solver_sweeps(const BenchOptions& options, const std::string& backend) {
  if (options.quick) return {{"finest", {{120, 40, 20, 2}}}, {"60 Hz", {{60, 10, 4, 2}, {60, 40, 16, 2}}}};
  std::vector<SolverSweep> all = {{"finest", {{240, 100, 40, 2}}},
                                  {"60 Hz", {{60, 5, 2, 2}, {60, 10, 4, 2}, {60, 20, 8, 2}, {60, 50, 20, 2}}},
                                  {"120 Hz", {{120, 10, 4, 2}, {120, 20, 8, 2}, {120, 50, 20, 2}}},
                                  {"240 Hz", {{240, 10, 4, 2}, {240, 50, 20, 2}}}};
  if (backend == "bullet") {
    all.push_back({"60 Hz, one friction direction", {{60, 10, 4, 1}, {60, 50, 20, 1}}});
    all.push_back({"120 Hz, one friction direction", {{120, 50, 20, 1}}});
  }
  return all;
}

std::vector<BenchGroup> convergence_groups(const BenchOptions& options, const std::string& scene,
                                           const std::string& backend) {
  BenchGroup group;
  for (const SolverSweep& sweep : solver_sweeps(options, backend)) {
    for (const Solver& solver : sweep.points) {
      BenchCase point{scene, backend, "full", options.settings, sweep.curve};
      point.settings.push_back(fmt::format("world.steps_per_second={}", solver.steps_per_second));
      point.settings.push_back(
          fmt::format("world.solver={{velocity_iterations={},position_iterations={},friction_directions={}}}",
                      solver.velocity_iterations, solver.position_iterations, solver.friction_directions));
      group.cases.push_back(point);
    }
  }
  return {group};
}

std::vector<CaseColumn> convergence_columns() {
  std::vector<CaseColumn> columns = name_columns();
  for (const CaseColumn& column :
       {plain("seconds"), with_deviation("centre"), with_deviation("r50"), with_deviation("r95"),
        with_deviation("angle_deg"), with_floor("profile_rms_D"), with_floor("ks_z"), plain("settling_per_minute"),
        plain("penetration_p99_D"), plain("penetration_max_D")}) {
    columns.push_back(column);
  }
  return columns;
}

/// `y` over the time that a run takes, a curve a time step.
CasePlot convergence_plot(MeasureId y, Bars bars, const std::string& caption) {
  return {.caption = caption,
          .x_label = "processor time of the run [s]",
          .x = measured("seconds"),
          .y = y,
          .log_x = true,
          .from_zero = false,
          .bars = bars,
          .curve = curve_of_case};
}

}  // namespace

void bench_convergence(const BenchOptions& options) {
  BenchOptions own = options;
  own.errors = true;
  own.reference = false;
  if (own.backends.empty())
    for (const int dimension : {2, 3}) std::ranges::copy(backends(dimension), std::back_inserter(own.backends));
  // 15 s of pour, 15 s after it.
  if (own.settings.empty()) own.settings = {"source[0].count=100", "run.frames=900"};
  run_report(
      {.title = "Convergence of the full simulation",
       .note = "Full runs at several steps, iterations and friction directions. The simulation counts as converged "
               "where a finer setting moves the shape by less than its scatter and the finished pile keeps its "
               "height.",
       .scenes = {"drop_in_a_pile"},
       .groups = convergence_groups,
       .columns = convergence_columns(),
       .plots = {convergence_plot("centre", Bars::deviation, "Height of the centre of mass, bars of one deviation."),
                 convergence_plot("r50", Bars::deviation, "Radius of half of the bodies, bars of one deviation."),
                 convergence_plot("settling_per_minute", Bars::none,
                                  "Share of its height that the finished pile loses per minute.")}},
      own);
}

}  // namespace talus
