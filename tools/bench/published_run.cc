#include "tools/bench/published_run.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/math/angle.h"
#include "common/measure/ensemble.h"
#include "common/scene/typical_body.h"
#include "common/text/file.h"
#include "common/world/stopwatch.h"
#include "tools/bench/janssen.h"
#include "tools/run/make_simulation.h"
#include "tools/run/run_files.h"
#include "tools/run/run_folder.h"

namespace talus {
namespace {

/// Tangent of the slope of the highest centres of one flank; `columns`: by the distance from the middle.
double fall_of(const std::map<int, double>& columns) {
  double n = 0.0, sx = 0.0, sz = 0.0, sxx = 0.0, sxz = 0.0;
  for (const auto& [x, z] : columns) {
    n += 1.0;
    sx += x;
    sz += z;
    sxx += static_cast<double>(x) * x;
    sxz += x * z;
  }
  return (sx * sz - n * sxz) / (n * sxx - sx * sx);
}

/// `width` of a body [m]. NaN where a flank is narrower than two columns.
template <int Dim>
double slope_of(const BodyStates<Dim>& states, double width) {
  constexpr double in_flight = 1.0;  // [m/s]
  std::vector<Vec<Dim>> resting;
  double edge = 0.0;
  for (BodyIndex i = 0; i < states.size(); ++i) {
    if (states.removed[i] != 0 || states.velocity[i].norm() > in_flight) continue;
    resting.push_back(states.pose[i].position);
    edge = std::max(edge, std::abs(resting.back()[0]));
  }
  std::map<int, double> flanks[2];
  for (const Vec<Dim>& at : resting) {
    const double out = std::abs(at[0]);
    if (out < 0.15 * edge || out > 0.85 * edge) continue;
    double& top = flanks[at[0] > 0.0 ? 1 : 0].try_emplace(static_cast<int>(out / width), height<Dim>(at)).first->second;
    top = std::max(top, height<Dim>(at));
  }
  return in_degrees(0.5 * (std::atan(fall_of(flanks[0]) / width) + std::atan(fall_of(flanks[1]) / width)));
}

/// NaN where no frame has one.
double mean_of_second_half(const std::vector<std::optional<double>>& all) {
  std::vector<double> known;
  for (std::size_t i = all.size() / 2; i < all.size(); ++i)
    if (all[i]) known.push_back(*all[i]);
  return mean_with_error(known).mean;
}

template <int Dim>
nlohmann::json janssen_json(const World<Dim>& world, const InstrumentMeters<Dim>& meters) {
  const std::optional<ColumnNumbers> numbers = column_numbers(world, meters);
  if (!numbers) return nullptr;
  return {{"saturation", numbers->saturation},
          {"decay_length", numbers->decay_length},
          {"pressure_ratio", numbers->pressure_ratio},
          {"friction", numbers->friction}};
}

template <int Dim>
double rank_of_first(const BodyStates<Dim>& states) {
  int lower = 0;
  for (BodyIndex i = 1; i < states.size(); ++i)
    lower += height<Dim>(states.pose[i].position) < height<Dim>(states.pose[0].position) ? 1 : 0;
  return lower / std::max(1.0, static_cast<double>(states.size()) - 1.0);
}

template <int Dim>
nlohmann::json run(const BenchCase& bench_case, const Scene<Dim>& scene, const std::filesystem::path& folder) {
  Simulation<Dim> simulation = make_simulation(scene, bench_case.backend);
  RunStatistics<Dim> statistics;
  InstrumentWatch<Dim> instruments(scene, folder);
  simulation.add_observer(statistics);
  simulation.add_observer(instruments);
  std::vector<std::optional<double>> slopes;
  Stopwatch watch;
  while (!simulation.finished()) {
    simulation.step();
    const InstrumentMeters<Dim>& meters = instruments.meters();
    if (meters.regions().empty() || meters.read_step() != simulation.frame().step) continue;
    const Applicable<SurfacePlane>& surface = meters.regions()[0].surface;
    slopes.push_back(surface.value ? std::optional(in_degrees(surface.value->angle)) : std::nullopt);
  }
  SummaryInput input{.scene_name = bench_case.scene_name(), .backend = bench_case.backend, .reason = "finished"};
  input.wall_seconds = watch.lap();
  simulation.end(input.reason);
  const std::filesystem::path file = folder / run_files::summary;
  write_summary(file, input, scene, simulation, statistics, instruments);
  nlohmann::json summary = nlohmann::json::parse(file_contents(file).value());
  const BodyStates<Dim>& states = simulation.world().states();
  const double width = typical_body(scene).extent / std::sqrt(Dim);  // of a ball
  summary["end"] = {{"slope_deg", slope_of(states, width)},
                    {"surface_deg", mean_of_second_half(slopes)},
                    {"janssen", janssen_json(simulation.world(), instruments.meters())},
                    {"rank_of_first", rank_of_first(states)}};
  return summary;
}

}  // namespace

nlohmann::json published_run(const BenchCase& bench_case, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  return std::visit([&](const auto& scene) { return run(bench_case, scene, folder); }, load(bench_case));
}

}  // namespace talus
