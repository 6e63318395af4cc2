#include "common/measure/wake_test.h"

#include <algorithm>
#include <cmath>

#include "common/math/require.h"
#include "common/measure/ensemble.h"
#include "common/world/energy.h"

namespace talus {
namespace {

template <int Dim>
class Observation {
 public:
  Observation(const WorldDescription<Dim>& description, const BodyStates<Dim>& start)
      : description_(description), start_(start) {
    for (std::size_t i = 0; i < start.shape.size(); ++i)
      if (!start.removed[i]) weight_ += weight(i);
  }

  void note_energy(const BodyStates<Dim>& states) {
    double sum = 0.0;
    for (BodyIndex i = 0; i < start_.size(); ++i) {
      if (start_.removed[i]) continue;
      const double energy = kinetic_energy(shape(i), states, i);
      result_.energy = std::max(result_.energy, energy / weight(i));
      sum += energy;
    }
    if (weight_ > 0.0) result_.energy_all = std::max(result_.energy_all, sum / weight_);
  }

  WakeTest finish(const BodyStates<Dim>& states, const WakeTestParams& params) {
    double mass = 0.0;
    double before = 0.0;
    double after = 0.0;
    for (std::size_t i = 0; i < start_.shape.size(); ++i) {
      if (start_.removed[i]) continue;
      const Vec<Dim>& from = start_.pose[i].position;
      const double displacement = (description_.periodic().near(states.pose[i].position, from) - from).norm();
      result_.displacements.push_back(displacement);
      mass += shape(i).mass;
      before += shape(i).mass * (height<Dim>(start_.pose[i].position) - description_.ground.height);
      after += shape(i).mass * (height<Dim>(states.pose[i].position) - description_.ground.height);
    }
    result_.bodies = static_cast<int>(result_.displacements.size());
    if (result_.bodies == 0) return result_;
    result_.mean = mean(result_.displacements);
    result_.p95 = quantile(result_.displacements, 0.95);
    result_.max = quantile(result_.displacements, 1.0);
    if (before > 0.0) result_.creep = (before - after) / before * 60.0 / params.duration;
    return result_;
  }

 private:
  const Shape<Dim>& shape(std::size_t i) const { return description_.shapes[start_.shape[i]]; }
  /// m g D: the energy of a fall by the body's own extent.
  double weight(std::size_t i) const { return shape(i).mass * description_.gravity * shape(i).extent; }

  const WorldDescription<Dim>& description_;
  const BodyStates<Dim>& start_;
  double weight_ = 0.0;
  WakeTest result_;
};

}  // namespace

double wake_time(double gravity) { return 5.0 * std::sqrt(9.81 / gravity); }

template <int Dim>
WakeTest wake_test(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                   const BodyStates<Dim>& states, const WakeTestParams& params) {
  require(params.duration > 0.0, "duration", params.duration, "must be > 0");
  require(params.energy_window > 0.0, "energy_window", params.energy_window, "must be > 0");
  require(description.gravity > 0.0, "gravity", description.gravity, "must be > 0, or nothing ever comes to rest");
  const std::unique_ptr<World<Dim>> world = rebuild(make_world, description, states, Sleepers::awake);
  Observation<Dim> observation(description, states);
  const int steps = static_cast<int>(std::ceil(params.duration / description.dt - 1e-9));
  for (int step = 1; step <= steps; ++step) {
    if (params.stop && params.stop()) break;
    world->step();
    if (step * description.dt <= params.energy_window + 1e-9) observation.note_energy(world->states());
  }
  return observation.finish(world->states(), params);
}

template WakeTest wake_test(const WorldMaker<2>&, const WorldDescription<2>&, const BodyStates<2>&,
                            const WakeTestParams&);
template WakeTest wake_test(const WorldMaker<3>&, const WorldDescription<3>&, const BodyStates<3>&,
                            const WakeTestParams&);

}  // namespace talus
