#include "common/measure/drift_probe.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/math/require.h"

namespace talus {
namespace {

// Times in units of DriftProbeParams::unit.
constexpr double between_samples = 0.4;
constexpr int fewest_samples = 3;
constexpr int most_samples = 12;

constexpr double certain = 3.0;  // `most` over `least` at which a probe may end

template <int Dim>
double mean_displacement(const BodyStates<Dim>& from, const World<Dim>& to, std::span<const std::uint8_t> counted,
                         int bodies) {
  double sum = 0.0;
  for (BodyIndex body = 0; body < from.size(); ++body)
    if (counted[body] != 0)
      sum += (to.pose_near(body, from.pose[body].position).position - from.pose[body].position).norm();
  return sum / bodies;
}

/// The mean speed over the later half of the samples, which are `between` seconds apart [D/s].
double present_speed(std::span<const double> samples, double between) {
  const std::size_t half = samples.size() / 2;
  const double before = half == 0 ? 0.0 : samples[half - 1];
  return std::max(0.0, samples.back() - before) / (static_cast<double>(samples.size() - half) * between);
}

}  // namespace

template <int Dim>
DriftProbe probe_drift(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                       const BodyStates<Dim>& states, std::span<const std::uint8_t> counted,
                       const DriftProbeParams& params) {
  require(params.extent > 0.0, "extent", params.extent, "must be > 0");
  require(params.unit > 0.0, "unit", params.unit, "must be > 0");
  require(params.duration > 0.0, "duration", params.duration, "must be > 0");
  const int bodies = static_cast<int>(std::ranges::count(counted, 1));
  const int steps = std::max(1, static_cast<int>(std::lround(between_samples * params.unit / description.dt)));
  const double between = steps * description.dt;
  const double affordable = params.body_steps / (static_cast<double>(states.size()) * steps);  // samples
  const double useful = std::ceil(params.duration / between);
  const int limit = static_cast<int>(std::min({affordable, useful, static_cast<double>(most_samples)}));
  if (bodies == 0 || limit < std::min(useful, static_cast<double>(fewest_samples))) return {};
  const std::unique_ptr<World<Dim>> world = rebuild(make_world, description, states, Sleepers::awake);
  DriftProbe probe;
  std::vector<double> samples;
  while (std::ssize(samples) < limit) {
    for (int step = 0; step < steps; ++step) {
      if (params.stop && params.stop()) return {};
      world->step();
    }
    samples.push_back(mean_displacement(states, *world, counted, bodies) / params.extent);
    const double seconds = static_cast<double>(samples.size()) * between;
    const double rest = std::max(0.0, params.duration - seconds);
    probe = {bodies, seconds, samples.back(), samples.back() + present_speed(samples, between) * rest};
    if (std::ssize(samples) >= fewest_samples && probe.most <= certain * probe.least) break;
  }
  return probe;
}

template DriftProbe probe_drift(const WorldMaker<2>&, const WorldDescription<2>&, const BodyStates<2>&,
                                std::span<const std::uint8_t>, const DriftProbeParams&);
template DriftProbe probe_drift(const WorldMaker<3>&, const WorldDescription<3>&, const BodyStates<3>&,
                                std::span<const std::uint8_t>, const DriftProbeParams&);

}  // namespace talus
