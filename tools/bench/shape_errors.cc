#include "tools/bench/shape_errors.h"

#include <functional>
#include <numbers>

#include "common/measure/ensemble.h"

namespace talus {
namespace {

template <int Dim>
using Number = std::function<double(const ShapeStatistics<Dim>&)>;

template <int Dim>
EnsembleSummary summary_of(const ShapeEnsemble<Dim>& ensemble, const Number<Dim>& number) {
  std::vector<double> numbers;
  for (const ShapeStatistics<Dim>& run : ensemble.runs) numbers.push_back(number(run));
  return summarize(numbers);
}

/// Mean profile over the runs, without run `left_out` (-1: none).
template <int Dim>
std::vector<ProfileBin> mean_profile(const ShapeEnsemble<Dim>& ensemble, int left_out) {
  std::vector<ProfileBin> profile = ensemble.runs.front().profile;
  for (std::size_t bin = 0; bin < profile.size(); ++bin) {
    std::vector<double> heights;
    for (std::size_t run = 0; run < ensemble.runs.size(); ++run)
      if (static_cast<int>(run) != left_out) heights.push_back(ensemble.runs[run].profile[bin].height);
    profile[bin].height = mean(heights);
  }
  return profile;
}

struct Distances {
  double kolmogorov_smirnov = 0.0;
  double wasserstein = 0.0;
};

/// Distance of each run's bodies from those of all other runs, mean over the runs.
Distances scatter(const RunSamples& samples) {
  Distances sum;
  for (std::size_t run = 0; run < samples.size(); ++run) {
    std::vector<double> others;
    for (std::size_t other = 0; other < samples.size(); ++other)
      if (other != run) others.insert(others.end(), samples[other].begin(), samples[other].end());
    const DistributionDistance distance = distribution_distance(samples[run], others);
    sum.kolmogorov_smirnov += distance.kolmogorov_smirnov;
    sum.wasserstein += distance.wasserstein;
  }
  const auto runs = static_cast<double>(samples.size());
  return {sum.kolmogorov_smirnov / runs, sum.wasserstein / runs};
}

/// Measures of one axis: `ks` and `w1` with their companions _p and _floor.
void add_distribution(MeasureId ks, MeasureId w1, const RunSamples& baseline, const RunSamples& runs, Values& values) {
  const DistributionTest test = test_distributions(runs, baseline);
  values[ks] = test.distance.kolmogorov_smirnov;
  values[ks.with("_p")] = test.p.kolmogorov_smirnov;
  values[w1] = test.distance.wasserstein;
  values[w1.with("_p")] = test.p.wasserstein;
  if (baseline.size() < 2) return;
  const Distances floor = scatter(baseline);
  values[ks.with("_floor")] = floor.kolmogorov_smirnov;
  values[w1.with("_floor")] = floor.wasserstein;
}

}  // namespace

template <int Dim>
ShapeEnsemble<Dim> shape_ensemble(std::span<const BodyStates<Dim>> states, std::span<const Shape<Dim>> shapes,
                                  const ProfileGrid<Dim>& grid) {
  constexpr double still = 1.0;  // [m/s]
  ShapeEnsemble<Dim> ensemble;
  for (const BodyStates<Dim>& run : states) {
    const auto bodies = placed_bodies<Dim>(shapes, run, still);
    if (bodies.empty()) continue;
    ensemble.runs.push_back(shape_statistics<Dim>(bodies, grid));
    ensemble.heights.push_back(heights<Dim>(bodies));
    ensemble.radii.push_back(radii<Dim>(bodies, grid.centre));
  }
  return ensemble;
}

template <int Dim>
void add_shape_errors(const ShapeEnsemble<Dim>& baseline, const ShapeEnsemble<Dim>& runs, double extent,
                      Values& values) {
  if (baseline.runs.empty() || runs.runs.empty()) return;
  const auto add = [&](MeasureId id, MeasureId off, double unit, const Number<Dim>& number) {
    const EnsembleSummary own = summary_of(runs, number);
    values[id] = own.mean;
    values[id.with("_sd")] = own.deviation;
    values[off] = (own.mean - summary_of(baseline, number).mean) / unit;
  };
  constexpr double degrees = 180.0 / std::numbers::pi;
  values["runs"] = static_cast<double>(runs.runs.size());
  add("centre", "centre_off_D", extent, [](const auto& shape) { return shape.centre_height; });
  add("r50", "r50_off_D", extent, [](const auto& shape) { return shape.r50; });
  add("r95", "r95_off_D", extent, [](const auto& shape) { return shape.r95; });
  add("peak", "peak_off_D", extent, [](const auto& shape) { return shape.peak; });
  add("angle_deg", "angle_off_deg", 1.0, [](const auto& shape) { return degrees * shape.repose.angle; });
  values["profile_rms_D"] = profile_difference(mean_profile(baseline, -1), mean_profile(runs, -1)) / extent;
  if (baseline.runs.size() > 1) {
    std::vector<double> floors;
    for (std::size_t run = 0; run < baseline.runs.size(); ++run) {
      floors.push_back(profile_difference(baseline.runs[run].profile, mean_profile(baseline, static_cast<int>(run))) /
                       extent);
    }
    values["profile_rms_D_floor"] = mean(floors);
  }
  add_distribution("ks_z", "w1_z", baseline.heights, runs.heights, values);
  add_distribution("ks_r", "w1_r", baseline.radii, runs.radii, values);
}

template ShapeEnsemble<2> shape_ensemble(std::span<const BodyStates<2>>, std::span<const Shape<2>>,
                                         const ProfileGrid<2>&);
template ShapeEnsemble<3> shape_ensemble(std::span<const BodyStates<3>>, std::span<const Shape<3>>,
                                         const ProfileGrid<3>&);
template void add_shape_errors(const ShapeEnsemble<2>&, const ShapeEnsemble<2>&, double, Values&);
template void add_shape_errors(const ShapeEnsemble<3>&, const ShapeEnsemble<3>&, double, Values&);

}  // namespace talus
