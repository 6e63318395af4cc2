#pragma once
// Trajectories drawn by hand, for measures with known answers.

#include <functional>

#include "common/measure/trajectory.h"

namespace talus {

/// States of `bodies` bodies of shape 0 at the given places, unturned, awake and at rest.
template <int Dim>
BodyStates<Dim> states_at(const std::vector<Vec<Dim>>& places) {
  BodyStates<Dim> states;
  states.shape.assign(places.size(), 0);
  for (const Vec<Dim>& place : places) states.pose.push_back({place, identity_rotation<Dim>()});
  states.velocity.assign(places.size(), Vec<Dim>::Zero());
  states.spin.assign(places.size(), Spin<Dim>::Zero());
  states.asleep.assign(places.size(), 0);
  states.removed.assign(places.size(), 0);
  return states;
}

/// Trajectory of `frames` frames at which the bodies stand where `places` says.
template <int Dim>
Trajectory<Dim> made_up_run(int frames, double frame_time, const std::function<std::vector<Vec<Dim>>(int)>& places,
                            const Periodic<Dim>& periodic = {}) {
  Trajectory<Dim> run(frame_time, 1, periodic);
  for (int frame = 0; frame < frames; ++frame) run.append(states_at<Dim>(places(frame)), frame + 1);
  return run;
}

}  // namespace talus
