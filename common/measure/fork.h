#pragma once
// Moments of a run from which it can be continued in other ways.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/measure/rebuild.h"
#include "common/measure/trajectory.h"
#include "common/scene/scene.h"

namespace talus {

/// A run's state after a step.
template <int Dim>
struct Fork {
  double time = 0.0;  // [s]
  BodyStates<Dim> states;
};

/// A body that a run added, as it was at the end of the step that added it: there a continuation puts it in.
template <int Dim>
struct Arrival {
  double time = 0.0;  // end of that step [s]
  BodyDef<Dim> body;
};

/// Keeps a fork every `frames_between` frames of output and every body that arrives.
template <int Dim>
class ForkRecorder : public Observer<Dim> {
 public:
  ForkRecorder(std::int64_t steps_per_frame, std::int64_t frames_between)
      : interval_(steps_per_frame * frames_between) {}
  void on_frame(const Frame<Dim>& frame) override;
  std::span<const Fork<Dim>> forks() const { return forks_; }
  std::span<const Arrival<Dim>> arrivals() const { return arrivals_; }  // by body, all of the run

 private:
  std::int64_t interval_;
  std::vector<Fork<Dim>> forks_;
  std::vector<Arrival<Dim>> arrivals_;
};

/// Goes on from a fork for a number of frames; the trajectory begins with the fork's own state. `arrivals` are those of
/// the whole run: the ones after the fork come in at their times.
template <int Dim>
using Continuation =
    std::function<Trajectory<Dim>(const Fork<Dim>& fork, std::span<const Arrival<Dim>> arrivals, int frames)>;

/// All bodies awake in a fresh world of `description`, whose dt divides `frame_time` [s]. `nudge` [m] moves the first
/// body along x beforehand: two continuations that differ by 1e-6 m show the effect of chaos.
template <int Dim>
Continuation<Dim> full_continuation(WorldMaker<Dim> make_world, WorldDescription<Dim> description, double frame_time,
                                    double nudge = 0.0);

/// The run itself, not forked at all: it goes on under its own policy, with all that its engine stores. `run` must
/// outlive the continuation and have a frame at each fork; beyond its end the result is shorter.
template <int Dim>
Continuation<Dim> recorded_continuation(const Trajectory<Dim>& run);

/// Plays `scene` again under its own policy until the fork's step, then wakes all bodies and lets none sleep any more.
/// Bodies that were awake keep all that the engine stores of them, so against a full run's recording this differs by
/// nothing, bit for bit: what is left is what sleeping, and waking at the fork, did. Each fork costs a run up to it:
/// take few. The settings are the scene's own. Throws std::invalid_argument for a scene with the engine's own sleeping,
/// which cannot be switched off on the way.
template <int Dim>
Continuation<Dim> replayed_continuation(WorldMaker<Dim> make_world, Scene<Dim> scene);

}  // namespace talus
