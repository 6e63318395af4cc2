#include "tools/bench/published_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/scene/typical_body.h"
#include "common/simulation/stopwatch.h"
#include "common/text/file.h"
#include "tools/run/make_simulation.h"
#include "tools/run/run_folder.h"

namespace talus {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

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
  return 0.5 * degrees * (std::atan(fall_of(flanks[0]) / width) + std::atan(fall_of(flanks[1]) / width));
}

/// Mean of the bodies that are in the world.
template <int Dim>
Vec<Dim> centre_of(const BodyStates<Dim>& states) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  int bodies = 0;
  for (BodyIndex i = 0; i < states.size(); ++i) {
    if (states.removed[i] != 0) continue;
    sum += states.pose[i].position;
    ++bodies;
  }
  return sum / std::max(1, bodies);
}

template <int Dim>
double mean_tilt(const std::vector<Vec<Dim>>& centres) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::size_t i = centres.size() / 2; i < centres.size(); ++i) sum += centres[i];
  return std::atan2(sum[0], -sum[Dim - 1]) * degrees;
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
  std::vector<Vec<Dim>> centres;
  Stopwatch watch;
  while (!simulation.finished()) {
    simulation.step();
    centres.push_back(centre_of(simulation.world().states()));
  }
  SummaryInput input{.scene_name = bench_case.scene_name(), .backend = bench_case.backend, .reason = "finished"};
  input.wall_seconds = watch.lap();
  simulation.end(input.reason);
  const std::filesystem::path file = folder / "summary.json";
  write_summary(file, input, scene, simulation, statistics, instruments);
  nlohmann::json summary = nlohmann::json::parse(file_contents(file).value());
  const BodyStates<Dim>& states = simulation.world().states();
  const double width = typical_body(scene).extent / std::sqrt(Dim);  // of a ball
  summary["end"] = {{"slope_deg", slope_of(states, width)},
                    {"tilt_deg", mean_tilt<Dim>(centres)},
                    {"rank_of_first", rank_of_first(states)}};
  return summary;
}

}  // namespace

nlohmann::json published_run(const BenchCase& bench_case, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  return std::visit([&](const auto& scene) { return run(bench_case, scene, folder); }, load(bench_case));
}

}  // namespace talus
