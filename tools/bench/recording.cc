#include "tools/bench/recording.h"

#include <algorithm>

#include "common/measure/work.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Time from which on no body has been awake.
template <int Dim>
class RestObserver final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override {
    if (!frame.world.awake().empty() || frame.world.states().size() == 0)
      since_.reset();
    else if (!since_)
      since_ = frame.time;
  }
  std::optional<double> since() const { return since_; }

 private:
  std::optional<double> since_;
};

template <int Dim>
Simulation<Dim> make_simulation(const Scene<Dim>& scene, const std::string& backend) {
  return Simulation<Dim>(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
}

}  // namespace

template <int Dim>
Recording<Dim> record(const Scene<Dim>& scene, const std::string& backend) {
  constexpr std::int64_t most_forks = 8;
  constexpr std::int64_t least_frames = 60;
  Simulation<Dim> simulation = make_simulation(scene, backend);
  TrajectoryRecorder<Dim> frames(scene.world.dt, scene.steps_per_frame());
  ForkRecorder<Dim> forks(scene.steps_per_frame(), std::max(least_frames, scene.run.frames / (most_forks + 1) + 1));
  WorkCounter<Dim> work(false);
  RestObserver<Dim> rest;
  simulation.add_observer(frames);
  simulation.add_observer(forks);
  simulation.add_observer(work);
  simulation.add_observer(rest);
  for (std::int64_t step = 0; step < scene.steps(); ++step) simulation.step();
  return {frames.trajectory(),
          simulation.world().states(),
          {forks.forks().begin(), forks.forks().end()},
          {forks.arrivals().begin(), forks.arrivals().end()},
          work.work().skipped(),
          rest.since()};
}

template <int Dim>
BodyStates<Dim> end_state(const Scene<Dim>& scene, const std::string& backend) {
  Simulation<Dim> simulation = make_simulation(scene, backend);
  for (std::int64_t step = 0; step < scene.steps(); ++step) simulation.step();
  return simulation.world().states();
}

template <int Dim>
Scene<Dim> perturbed(Scene<Dim> scene) {
  if (!scene.sources.empty()) scene.sources.front().position[0] += 1e-6;
  return scene;
}

template <int Dim>
Scene<Dim> reseeded(Scene<Dim> scene, int k) {
  scene.seed += 1000 * static_cast<std::uint64_t>(k);
  return scene;
}

template Recording<2> record(const Scene<2>&, const std::string&);
template Recording<3> record(const Scene<3>&, const std::string&);
template BodyStates<2> end_state(const Scene<2>&, const std::string&);
template BodyStates<3> end_state(const Scene<3>&, const std::string&);
template Scene<2> perturbed(Scene<2>);
template Scene<3> perturbed(Scene<3>);
template Scene<2> reseeded(Scene<2>, int);
template Scene<3> reseeded(Scene<3>, int);

}  // namespace talus
