#include "common/measure/replay.h"

#include <cmath>

#include "common/math/require.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"

namespace talus {
namespace {

/// Another policy up to a step, at which it wakes all bodies; from then on nothing.
template <int Dim>
class UntilStep final : public SleepPolicy<Dim> {
 public:
  UntilStep(std::unique_ptr<SleepPolicy<Dim>> policy, std::int64_t step) : policy_(std::move(policy)), step_(step) {}

  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override {
    if (frame.step < step_ && policy_->decides()) policy_->decide(frame, decision);
    if (frame.step != step_) return;
    const BodyStates<Dim>& states = frame.world.states();
    for (BodyIndex body = 0; body < states.size(); ++body) {
      if (states.asleep[body] && !states.removed[body])
        decision.thaw.push_back({.body = body, .cause = SleepCause::user});
    }
  }

 private:
  std::unique_ptr<SleepPolicy<Dim>> policy_;
  std::int64_t step_;
};

}  // namespace

template <int Dim>
Continuation<Dim> replayed_continuation(WorldMaker<Dim> make_world, Scene<Dim> scene) {
  require(!scene.world.engine_sleep, "engine_sleep", 1.0, "must be off: it cannot be switched off on the way");
  return [make_world = std::move(make_world), scene = std::move(scene)](const Fork<Dim>& fork,
                                                                        std::span<const Arrival<Dim>>, int frames) {
    const std::int64_t start = std::llround(fork.time / scene.world.dt);
    const std::int64_t steps_per_frame = scene.steps_per_frame();
    auto policy = std::make_unique<UntilStep<Dim>>(make_policy(scene), start);
    Simulation<Dim> simulation(scene, make_world(scene.world), std::move(policy));
    for (std::int64_t step = 0; step < start; ++step) simulation.step();
    Trajectory<Dim> trajectory(scene.world.dt, steps_per_frame);
    trajectory.append(simulation.world().states(), start);
    for (int frame = 1; frame <= frames; ++frame) {
      for (std::int64_t step = 0; step < steps_per_frame; ++step) simulation.step();
      trajectory.append(simulation.world().states(), start + frame * steps_per_frame);
    }
    return trajectory;
  };
}

template Continuation<2> replayed_continuation(WorldMaker<2>, Scene<2>);
template Continuation<3> replayed_continuation(WorldMaker<3>, Scene<3>);

}  // namespace talus
