#include <fmt/format.h>

#include <cmath>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/plot/plot.h"
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

/// One curve: settings from coarse to fine.
struct StepSweep {
  std::string name;
  std::vector<Solver> points;
};

/// Finer than any of the sweeps: what they are measured against.
Solver finest(const BenchOptions& options) { return options.quick ? Solver{120, 40, 20, 2} : Solver{240, 100, 40, 2}; }

std::vector<StepSweep> sweeps(const BenchOptions& options, const std::string& backend) {
  if (options.quick) return {{"60 Hz", {{60, 10, 4, 2}, {60, 40, 16, 2}}}};
  std::vector<StepSweep> all = {{"60 Hz", {{60, 5, 2, 2}, {60, 10, 4, 2}, {60, 20, 8, 2}, {60, 50, 20, 2}}},
                                {"120 Hz", {{120, 10, 4, 2}, {120, 20, 8, 2}, {120, 50, 20, 2}}},
                                {"240 Hz", {{240, 10, 4, 2}, {240, 50, 20, 2}}}};
  if (backend == "bullet") {
    all.push_back({"60 Hz, one friction direction", {{60, 10, 4, 1}, {60, 50, 20, 1}}});
    all.push_back({"120 Hz, one friction direction", {{120, 50, 20, 1}}});
  }
  return all;
}

std::string name_of(const Solver& solver, const std::string& backend) {
  std::string name = fmt::format("{}", solver.velocity_iterations);
  if (backend == "box2d") name += fmt::format(" + {}", solver.position_iterations);
  return name;
}

BenchCase case_of(const BenchOptions& options, const std::string& scene, const std::string& backend,
                  const Solver& solver) {
  BenchCase bench_case{scene, backend, "full", options.settings};
  for (const std::string& setting :
       {fmt::format("world.steps_per_second={}", solver.steps_per_second),
        fmt::format("world.solver={{velocity_iterations={},position_iterations={},friction_directions={}}}",
                    solver.velocity_iterations, solver.position_iterations, solver.friction_directions)}) {
    bench_case.settings.push_back(setting);
  }
  return bench_case;
}

struct Study {
  std::string scene;
  std::string backend;
  BenchGroup group;  // the finest first
};

Table table_of(const BenchRunner& runner, const Study& study) {
  Table table{"", {{"steps"}, {"iterations"}, {"time [s]", true}}, {}};
  for (const char* name : {"centre [m]", "r50 [m]", "r95 [m]", "angle [°]", "off: centre / D", "r50 / D", "profile / D",
                           "its floor", "KS(z)", "its floor", "settling / min", "penetration 99 % / D", "max / D"}) {
    table.columns.push_back({name, true});
  }
  const auto add = [&](const std::string& sweep, const Solver& solver) {
    const Values values =
        runner.summary(case_of(runner.options(), study.scene, study.backend, solver), study.group.cases.front());
    const auto with_sd = [&](const std::string& name) {
      return shown(value_of(values, name)) + " ± " + shown(value_of(values, name + "_sd"), 2);
    };
    const auto plain = [&](const std::string& name) { return shown(value_of(values, name), 2); };
    table.rows.push_back({sweep, name_of(solver, study.backend), shown(value_of(values, "seconds")), with_sd("centre"),
                          with_sd("r50"), with_sd("r95"), with_sd("angle_deg"), plain("centre_off_D"),
                          plain("r50_off_D"), plain("profile_rms_D"), plain("profile_rms_D_floor"), plain("ks_z"),
                          plain("ks_z_floor"), plain("settling_per_minute"), plain("penetration_p99_D"),
                          plain("penetration_max_D")});
  };
  add(fmt::format("finest: {} Hz", finest(runner.options()).steps_per_second), finest(runner.options()));
  for (const StepSweep& sweep : sweeps(runner.options(), study.backend)) {
    for (const Solver& solver : sweep.points) add(sweep.name, solver);
  }
  return table;
}

Plot plot_of(const BenchRunner& runner, const Study& study, const std::string& name, const std::string& label,
             bool with_deviation) {
  Plot plot{.title = study.backend,
            .x_label = "processor time of the run [s]",
            .y_label = label,
            .log_x = true,
            .from_zero = false,
            .series = {}};
  const auto add = [&](Series& series, const Solver& solver) {
    const Values values =
        runner.summary(case_of(runner.options(), study.scene, study.backend, solver), study.group.cases.front());
    const double value = value_of(values, name);
    if (!std::isfinite(value) || !std::isfinite(value_of(values, "seconds"))) return;
    series.x.push_back(value_of(values, "seconds"));
    series.y.push_back(value);
    if (!with_deviation) return;
    series.low.push_back(value - value_of(values, name + "_sd"));
    series.high.push_back(value + value_of(values, name + "_sd"));
  };
  for (const StepSweep& sweep : sweeps(runner.options(), study.backend)) {
    Series series{sweep.name, {}, {}};
    series.style = SeriesStyle::line_and_points;
    for (const Solver& solver : sweep.points) add(series, solver);
    if (!series.x.empty()) plot.series.push_back(series);
  }
  Series fine{"finest", {}, {}};
  fine.style = SeriesStyle::points;
  add(fine, finest(runner.options()));
  if (!fine.x.empty()) plot.series.push_back(fine);
  return plot;
}

Section section_of(const BenchRunner& runner, const Study& study) {
  Section section{study.scene + ", " + study.backend, {table_of(runner, study)}};
  const auto add = [&](const std::string& name, const std::string& label, bool with_deviation,
                       const std::string& caption) {
    const Plot plot = plot_of(runner, study, name, label, with_deviation);
    if (!plot.series.empty()) section.blocks.emplace_back(Figure{svg_of(plot), caption});
  };
  add("centre", "height of the centre of mass [m]", true, "Mean over the twins, bars of one standard deviation.");
  add("r50", "r50 [m]", true, "Likewise.");
  add("settling_per_minute", "height lost per minute at rest / height", false,
      "Of the finished pile, from five seconds after the last body on.");
  return section;
}

}  // namespace

void bench_convergence(const BenchOptions& options) {
  BenchOptions own = options;
  own.errors = true;
  own.reference = false;
  if (own.backends.empty()) {
    for (const int dimension : {2, 3}) {
      for (const std::string& backend : backends(dimension)) own.backends.push_back(backend);
    }
  }
  if (own.settings.empty()) own.settings = {"source[0].count=100", "run.frames=900"};  // 15 s of pour, 15 s of calm
  std::vector<Study> studies;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(own, {"drop_in_a_pile"}, 1)) {
    for (const std::string& backend : backends_of(own, scene)) {
      Study study{scene, backend, {{case_of(own, scene, backend, finest(own))}}};
      for (const StepSweep& sweep : sweeps(own, backend)) {
        for (const Solver& solver : sweep.points) study.group.cases.push_back(case_of(own, scene, backend, solver));
      }
      groups.push_back(study.group);
      studies.push_back(std::move(study));
    }
  }
  BenchRunner runner(own);
  runner.run(groups);
  BenchResults results{"Convergence of the full simulation", {}, {}};
  results.notes.push_back(
      fmt::format("Nobody sleeps; {} runs a side. Where a finer setting no longer moves the shape by more than it "
                  "scatters, and the "
                  "finished pile stays as high as it is, the simulation counts as converged.",
                  own.twins));
  for (const Study& study : studies) results.sections.push_back(section_of(runner, study));
  write_results(runner, groups, results);
  for (const Study& study : studies) fmt::print("\n{}\n{}", study.backend, text_of(table_of(runner, study)));
}

}  // namespace talus
