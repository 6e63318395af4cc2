#pragma once
// A run recorded for the measures; it is not timed.

#include <optional>
#include <string>

#include "common/measure/fork.h"
#include "common/measure/trajectory.h"
#include "common/scene/scene.h"

namespace talus {

template <int Dim>
struct Recording {
  Trajectory<Dim> frames;
  BodyStates<Dim> last;
  /// Eight or fewer, sixty frames or more apart.
  std::vector<Fork<Dim>> forks;
  std::vector<Arrival<Dim>> arrivals;
  /// Share of body-steps.
  double work_skipped = 0.0;
  /// From then on every body sleeps [s]; empty where one is awake at the end.
  std::optional<double> asleep_at;
};

template <int Dim>
Recording<Dim> record(const Scene<Dim>& scene, const std::string& backend);

/// The last state only.
template <int Dim>
BodyStates<Dim> end_state(const Scene<Dim>& scene, const std::string& backend);

/// The scene with its first source moved by 1e-6 m along x: how far apart chaos alone brings two runs.
template <int Dim>
Scene<Dim> perturbed(Scene<Dim> scene);

/// Independent run `k` of the scene: the same scene with another seed; 0 is the scene itself.
template <int Dim>
Scene<Dim> reseeded(Scene<Dim> scene, int k);

}  // namespace talus
