#include "common/measure/fork.h"

#include <algorithm>
#include <cmath>

#include "common/math/require.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"

namespace talus {

template <int Dim>
void ForkRecorder<Dim>::on_frame(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  for (std::size_t i = arrivals_.size(); i < states.shape.size(); ++i)
    arrivals_.push_back({frame.time, {states.shape[i], states.pose[i], states.velocity[i], states.spin[i]}});
  if (frame.step % interval_ == 0) forks_.push_back({frame.time, states});
}

namespace {

template <int Dim>
Trajectory<Dim> continue_full(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                              std::int64_t steps_per_frame, double nudge, const Fork<Dim>& fork,
                              std::span<const Arrival<Dim>> arrivals, int frames) {
  BodyStates<Dim> states = fork.states;
  const auto first = std::find(states.removed.begin(), states.removed.end(), std::uint8_t{0});
  if (first != states.removed.end()) states.pose[first - states.removed.begin()].position.x() += nudge;
  const std::unique_ptr<World<Dim>> world = rebuild(make_world, description, states, Sleepers::awake);
  Trajectory<Dim> trajectory(description.dt, steps_per_frame);
  std::int64_t step = std::llround(fork.time / description.dt);
  trajectory.append(world->states(), step);
  std::size_t next = states.shape.size();
  while (trajectory.frames() <= frames) {
    for (std::int64_t k = 0; k < steps_per_frame; ++k) {
      world->step();
      ++step;
      const double time = static_cast<double>(step) * description.dt + 1e-9;
      while (next < arrivals.size() && arrivals[next].time <= time) world->add(arrivals[next++].body);
    }
    trajectory.append(world->states(), step);
  }
  return trajectory;
}

}  // namespace

template <int Dim>
Continuation<Dim> full_continuation(WorldMaker<Dim> make_world, WorldDescription<Dim> description, double frame_time,
                                    double nudge) {
  const std::int64_t steps = std::llround(frame_time / description.dt);
  require(steps >= 1 && std::abs(static_cast<double>(steps) * description.dt - frame_time) < 1e-9 * frame_time, "dt",
          description.dt, "must divide the time of a frame");
  return [make_world = std::move(make_world), description = std::move(description), steps, nudge](
             const Fork<Dim>& fork, std::span<const Arrival<Dim>> arrivals, int frames) {
    return continue_full(make_world, description, steps, nudge, fork, arrivals, frames);
  };
}

template <int Dim>
Continuation<Dim> recorded_continuation(const Trajectory<Dim>& run) {
  return [&run](const Fork<Dim>& fork, std::span<const Arrival<Dim>>, int frames) {
    const auto step = std::llround(fork.time / run.step_time());
    const auto frame = run.frames() == 0 ? -1 : (step - run.step(0)) / run.steps_per_frame();
    require(frame >= 0 && frame < run.frames() && run.step(static_cast<int>(frame)) == step, "fork.time", fork.time,
            "must be the time of a frame of the run");
    return run.part(static_cast<int>(frame), frames + 1);
  };
}

template class ForkRecorder<2>;
template class ForkRecorder<3>;
template Continuation<2> full_continuation(WorldMaker<2>, WorldDescription<2>, double, double);
template Continuation<3> full_continuation(WorldMaker<3>, WorldDescription<3>, double, double);
template Continuation<2> recorded_continuation(const Trajectory<2>&);
template Continuation<3> recorded_continuation(const Trajectory<3>&);

namespace {

/// Another policy up to a step, at which it wakes all bodies; from then on nothing.
template <int Dim>
class UntilStep final : public SleepPolicy<Dim> {
 public:
  UntilStep(std::unique_ptr<SleepPolicy<Dim>> policy, std::int64_t step) : policy_(std::move(policy)), step_(step) {}

  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override {
    if (frame.step < step_) policy_->decide(frame, decision);
    if (frame.step != step_) return;
    const BodyStates<Dim>& states = frame.world.states();
    for (BodyIndex body = 0; body < states.size(); ++body)
      if (states.asleep[body] && !states.removed[body])
        decision.thaw.push_back({.body = body, .cause = SleepCause::user});
  }
  void note(const World<Dim>& world, std::span<const SleepEvent> events) override { policy_->note(world, events); }
  bool needs_contacts() const override { return policy_->needs_contacts(); }
  bool counts_flying() const override { return policy_->counts_flying(); }

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
