#pragma once
// A run recorded for the measures; its time is not taken.

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
  std::vector<Fork<Dim>> forks;  // eight or fewer, sixty frames or more apart
  std::vector<Arrival<Dim>> arrivals;
  double work_skipped = 0.0;        // share of body-steps
  std::optional<double> asleep_at;  // from when on nobody was awake [s]; nothing where somebody is at the end
};

template <int Dim>
Recording<Dim> record(const Scene<Dim>& scene, const std::string& backend);

/// The last state only.
template <int Dim>
BodyStates<Dim> end_state(const Scene<Dim>& scene, const std::string& backend);

/// Twin `k` of a scene: the first source moved by 1e-6 k m along x. Twin 0 is the scene itself.
template <int Dim>
Scene<Dim> twin(Scene<Dim> scene, int k);

/// Another world of chances: the same scene, another seed.
template <int Dim>
Scene<Dim> unrelated(Scene<Dim> scene);

}  // namespace talus
