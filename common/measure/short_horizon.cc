#include "common/measure/short_horizon.h"

#include <algorithm>

#include "common/measure/ensemble.h"
#include "common/measure/motion_error.h"

namespace talus {
namespace {

/// Adds up one horizon over the forks.
template <int Dim>
struct Horizon {
  HorizonError error;
  std::vector<double> distances;  // over D

  void add(const Trajectory<Dim>& full, const Trajectory<Dim>& other, std::span<const MotionError> motion,
           std::span<const double> extents) {
    if (std::min(full.frames(), other.frames()) <= error.frames) return;
    const MotionError so_far = average(motion.first(error.frames));
    ++error.forks;
    error.ratio += so_far.ratio;
    error.symmetric += so_far.symmetric;
    for (BodyIndex i = 0; i < full.bodies(0); ++i) {
      if (!full.present(0, i) || !full.present(error.frames, i) || !other.present(error.frames, i)) continue;
      const double distance = (full.position(error.frames, i) - other.position(error.frames, i)).norm();
      distances.push_back(distance / extents[full.shape(i)]);
    }
  }

  HorizonError finish() {
    if (error.forks == 0) return error;
    error.ratio /= error.forks;
    error.symmetric /= error.forks;
    error.mean = mean(distances);
    error.p95 = quantile(distances, 0.95);
    error.max = quantile(distances, 1.0);
    return error;
  }
};

}  // namespace

template <int Dim>
std::vector<HorizonError> horizon_errors(std::span<const Fork<Dim>> forks, std::span<const Arrival<Dim>> arrivals,
                                         const Continuation<Dim>& full, const Continuation<Dim>& other,
                                         std::span<const double> extents, double gravity, std::vector<int> horizons) {
  if (horizons.empty()) return {};
  std::vector<Horizon<Dim>> sums(horizons.size());
  for (std::size_t h = 0; h < horizons.size(); ++h) sums[h].error.frames = horizons[h];
  const int longest = *std::max_element(horizons.begin(), horizons.end());
  for (const Fork<Dim>& fork : forks) {
    const Trajectory<Dim> one = full(fork, arrivals, longest);
    const Trajectory<Dim> two = other(fork, arrivals, longest);
    const std::vector<MotionError> motion = motion_errors(one, two, extents, gravity);
    for (Horizon<Dim>& horizon : sums) horizon.add(one, two, motion, extents);
  }
  std::vector<HorizonError> errors;
  errors.reserve(sums.size());
  for (Horizon<Dim>& horizon : sums) errors.push_back(horizon.finish());
  return errors;
}

template std::vector<HorizonError> horizon_errors(std::span<const Fork<2>>, std::span<const Arrival<2>>,
                                                  const Continuation<2>&, const Continuation<2>&,
                                                  std::span<const double>, double, std::vector<int>);
template std::vector<HorizonError> horizon_errors(std::span<const Fork<3>>, std::span<const Arrival<3>>,
                                                  const Continuation<3>&, const Continuation<3>&,
                                                  std::span<const double>, double, std::vector<int>);

}  // namespace talus
