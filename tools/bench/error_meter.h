#pragma once
// How far the runs of a scene are from a baseline: the full simulation at the same settings, or the reference.

#include <span>
#include <string>
#include <vector>

#include "tools/bench/measure.h"
#include "tools/bench/recording.h"
#include "tools/bench/shape_errors.h"

namespace talus {

template <int Dim>
class ErrorMeter {
 public:
  /// Runs the baseline over `seeds` >= 1 independent seeds (two at least), and one perturbed run for the floors.
  ErrorMeter(const Scene<Dim>& baseline, std::string backend, int seeds);

  /// Measures of the baseline itself: floors, hindsight, its own shape and drift.
  const Values& of_baseline() const { return of_baseline_; }

  /// Runs `scene` over the same seeds and measures its errors.
  Values measure(const Scene<Dim>& scene) const;

 private:
  void add_floors(std::span<const BodyStates<Dim>> ends);
  void add_motion(const Trajectory<Dim>& frames, Values& values) const;
  void add_horizon(const Recording<Dim>& run, Values& values) const;
  void add_last_state(const Recording<Dim>& run, Values& values) const;
  void add_drift(std::span<const BodyStates<Dim>> ends, Values& values) const;
  void add_work(const Recording<Dim>& run, Values& values) const;

  Scene<Dim> scene_;
  std::string backend_;
  int seeds_;
  /// D of the scene's bodies [m].
  double extent_;
  Recording<Dim> full_;
  ProfileGrid<Dim> grid_;
  ShapeEnsemble<Dim> shapes_;
  Values of_baseline_;
};

}  // namespace talus
