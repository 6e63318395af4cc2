#include "tools/stress/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/measure/shape_statistics.h"
#include "common/measure/support.h"
#include "common/scene/read_scene.h"
#include "common/scene/window.h"
#include "tools/bench/in_processes.h"
#include "tools/bench/recording.h"
#include "tools/output/output.h"
#include "tools/report/table.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

using Json = nlohmann::json;

/// The least steps a second that a scene may have.
constexpr double least_rate = 30.0;

struct AdviceSetting {
  double rate = 60.0;
  int iterations = 10;
};

template <int Dim>
AdviceSetting own_setting(const Scene<Dim>& scene) {
  return {1.0 / scene.world.dt, scene.world.solver.velocity_iterations};
}

template <int Dim>
Scene<Dim> with_setting(Scene<Dim> scene, const AdviceSetting& setting) {
  scene.world.dt = 1.0 / setting.rate;
  scene.world.solver.velocity_iterations = setting.iterations;
  return scene;
}

/// Half, own and double of both; rates that the scene may not have, or that its frames do not divide, and settings
/// outside of the engine's window are left out.
template <int Dim>
std::vector<AdviceSetting> settings_around(const Scene<Dim>& scene, const EngineTraits& engine) {
  const AdviceSetting own = own_setting(scene);
  std::vector<AdviceSetting> settings;
  for (const double factor : {0.5, 1.0, 2.0}) {
    const double rate = own.rate * factor;
    const double frame = rate / scene.run.frame_rate;
    if (rate < least_rate - 1e-6 || std::abs(frame - std::round(frame)) > 1e-6) continue;
    for (const double share : {0.5, 1.0, 2.0}) {
      const AdviceSetting setting{rate, std::max(1, static_cast<int>(std::lround(own.iterations * share)))};
      if (outside_window(with_setting(scene, setting), engine, "").empty()) settings.push_back(setting);
    }
  }
  return settings;
}

/// Runs the scene to its end; what counts as JSON.
template <int Dim>
std::string measure_setting(const Scene<Dim>& plain, const std::string& backend, const AdviceSetting& setting) {
  struct Watcher : Observer<Dim> {
    void on_frame(const Frame<Dim>& /*frame*/) override {}
  };
  const Scene<Dim> scene = with_setting(plain, setting);
  Watcher watcher;
  Simulation<Dim> simulation = make_simulation(scene, backend);
  simulation.add_observer(watcher);
  ProcessorWatch watch;
  while (!simulation.finished()) simulation.step();
  const double seconds = watch.lap();
  const double extent = simulation.piles().typical_body().extent;
  const auto bodies = placed_bodies<Dim>(scene.world.shapes, simulation.world().states());
  const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, scene.world.ground.height, extent);
  const ShapeStatistics<Dim> shape = shape_statistics<Dim>(bodies, grid);
  const auto pairs = touching_pairs(scene.world, simulation.world().states(), 0.01 * extent);
  return Json{{"centre", shape.centre_height / extent},
              {"r50", shape.r50 / extent},
              {"overlap", penetration(pairs).p99 / extent},
              {"warnings", simulation.warnings().size()},
              {"seconds", seconds}}
      .dump();
}

/// The values of one setting, a seed each.
struct AdviceSample {
  std::vector<double> centre;
  std::vector<double> r50;
  double overlap = 0.0;
  double seconds = 0.0;
  int warnings = 0;
  bool failed = false;
};

void take(AdviceSample& sample, const TaskOutcome& outcome, int seeds) {
  if (outcome.failed) {
    print_message("a run failed: {}", outcome.text);
    sample.failed = true;
    return;
  }
  const Json json = Json::parse(outcome.text);
  sample.centre.push_back(json["centre"]);
  sample.r50.push_back(json["r50"]);
  sample.overlap = std::max(sample.overlap, json["overlap"].get<double>());
  sample.seconds += json["seconds"].get<double>() / seeds;
  sample.warnings = std::max(sample.warnings, json["warnings"].get<int>());
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Variance of the mean.
double variance_of_mean(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size() * (values.size() - 1));
}

AdviceRow row_against(const AdviceSample& sample, const AdviceSample& finest, const AdviceSetting& setting) {
  AdviceRow row;
  row.steps_per_second = setting.rate;
  row.iterations = setting.iterations;
  row.failed = sample.failed;
  row.overlap = sample.overlap;
  row.warnings = sample.warnings;
  row.seconds = sample.seconds;
  if (sample.failed) return row;
  row.centre_off = mean_of(sample.centre) - mean_of(finest.centre);
  row.r50_off = mean_of(sample.r50) - mean_of(finest.r50);
  if (&sample == &finest) return row;
  row.centre_error = std::sqrt(variance_of_mean(sample.centre) + variance_of_mean(finest.centre));
  row.r50_error = std::sqrt(variance_of_mean(sample.r50) + variance_of_mean(finest.r50));
  return row;
}

std::string setting_text(const AdviceRow& row) {
  return fmt::format("{:g} steps a second and {} iterations", row.steps_per_second, row.iterations);
}

Table advice_table(const std::vector<AdviceRow>& rows, double tolerance) {
  Table table{"",
              {{"steps/s", true},
               {"iterations", true},
               {"centre off / D", true},
               {"r50 off / D", true},
               {"overlap / D", true},
               {"warnings", true},
               {"time [s]", true},
               {"verdict"}},
              {}};
  for (const AdviceRow& row : rows) {
    table.rows.push_back({fmt::format("{:g}", row.steps_per_second), std::to_string(row.iterations),
                          fmt::format("{:.3f} ± {:.3f}", row.centre_off, row.centre_error),
                          fmt::format("{:.3f} ± {:.3f}", row.r50_off, row.r50_error),
                          fmt::format("{:.3f}", row.overlap), std::to_string(row.warnings),
                          fmt::format("{:.3g}", row.seconds),
                          fmt::format("{}{}",
                                      row.suffices(tolerance)  ? "suffices"
                                      : row.is_open(tolerance) ? "open"
                                                               : "does not suffice",
                                      row.own ? ", the scene's own" : "")});
  }
  return table;
}

template <int Dim>
void advise_on(const Scene<Dim>& scene, const AdviceOptions& options) {
  const std::string backend = options.backend.empty() ? backends(Dim).at(0) : options.backend;
  const std::vector<AdviceSetting> settings = settings_around(scene, engine_traits<Dim>(backend));
  if (settings.empty())
    throw std::invalid_argument(
        fmt::format("{}: neither half, its own nor double steps and iterations lie in the window "
                    "in which results on {} hold (docs/limits.md)",
                    options.scene, backend));
  std::vector<AdviceSample> samples(settings.size());
  in_processes(
      static_cast<int>(settings.size()) * options.seeds, options.jobs,
      [&](int i) { return measure_setting(reseeded(scene, i % options.seeds), backend, settings[i / options.seeds]); },
      [&](int i, const TaskOutcome& outcome) { take(samples[i / options.seeds], outcome, options.seeds); });
  if (samples.back().failed) throw std::runtime_error("the finest setting failed, so there is nothing to compare with");
  const AdviceSetting own = own_setting(scene);
  std::vector<AdviceRow> rows;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    rows.push_back(row_against(samples[i], samples.back(), settings[i]));
    rows.back().own = settings[i].rate == own.rate && settings[i].iterations == own.iterations;
  }
  print_result("{} on {}, policy {}: {} runs at each setting, compared with {}\n\n", options.scene, backend,
               scene.policy.kind, options.seeds, setting_text(rows.back()));
  print_text(text_of(advice_table(rows, options.tolerance)));
  print_result("\n{}\n", advice(rows, options.tolerance));
}

}  // namespace

namespace {

/// Whether nothing went wrong and heights and radii lie within the tolerance and so many standard errors.
bool lies_within(const AdviceRow& row, double tolerance, double errors) {
  return !row.failed && row.warnings == 0 && row.overlap <= tolerance &&
         std::abs(row.centre_off) <= tolerance + errors * row.centre_error &&
         std::abs(row.r50_off) <= tolerance + errors * row.r50_error;
}

}  // namespace

bool AdviceRow::suffices(double tolerance) const { return lies_within(*this, tolerance, 0.0); }

bool AdviceRow::is_open(double tolerance) const { return !suffices(tolerance) && lies_within(*this, tolerance, 2.0); }

std::string advice(const std::vector<AdviceRow>& rows, double tolerance) {
  const AdviceRow* cheapest = nullptr;
  const AdviceRow* own = nullptr;
  double largest_error = 0.0;
  for (const AdviceRow& row : rows) {
    largest_error = std::max({largest_error, row.centre_error, row.r50_error});
    if (row.own) own = &row;
    if (row.suffices(tolerance) && (cheapest == nullptr || row.seconds < cheapest->seconds)) cheapest = &row;
  }
  std::string text;
  if (cheapest == nullptr)
    return fmt::format(
        "No setting suffices for {:g} D: raise world.steps_per_second and "
        "world.solver.velocity_iterations, and see the warnings of `talus run`.",
        tolerance);
  text = fmt::format("Cheapest that suffices for {:g} D: {}.", tolerance, setting_text(*cheapest));
  if (own != nullptr && own != cheapest)
    if (own->is_open(tolerance))
      text += fmt::format(" Whether the scene's own, {}, suffice is open.", setting_text(*own));
    else if (!own->suffices(tolerance))
      text += fmt::format(" The scene's own, {}, do not suffice.", setting_text(*own));
    else
      text += fmt::format(" The scene's own, {}, take {:.2g} times its time.", setting_text(*own),
                          own->seconds / cheapest->seconds);
  else if (own == cheapest)
    text += " These are the scene's own.";
  if (2.0 * largest_error > tolerance)
    text += fmt::format(
        " The means are uncertain by up to {:.2g} D (two standard errors): more --seeds tell settings "
        "apart that differ by less.",
        2.0 * largest_error);
  return text;
}

void advise(const AdviceOptions& options) {
  if (options.seeds < 1) throw std::invalid_argument("--seeds: must be 1 or more");
  std::vector<Override> overrides;
  if (!options.policy.empty()) overrides.push_back({"policy.kind=" + options.policy, "--policy " + options.policy});
  const AnyScene scene = read_scene(find_scene(options.scene), overrides);
  std::visit([&](const auto& of_dimension) { advise_on(of_dimension, options); }, scene);
}

}  // namespace talus
