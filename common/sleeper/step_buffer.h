#pragma once

#include <vector>

#include "common/sleeper/given_step.h"

namespace talus {

/// Memory for a GivenStep, kept from step to step.
template <int Dim>
struct StepBuffer {
  std::vector<Handle> bodies;
  std::vector<Pose<Dim>> poses;
  std::vector<Vec<Dim>> velocities;
  std::vector<Spin<Dim>> spins;
  std::vector<GivenContact<Dim>> contacts;

  void clear() {
    bodies.clear();
    poses.clear();
    velocities.clear();
    spins.clear();
    contacts.clear();
  }
  void add(Handle body, const Pose<Dim>& pose, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
    bodies.push_back(body);
    poses.push_back(pose);
    velocities.push_back(velocity);
    spins.push_back(spin);
  }
  /// `dt` [s]. Valid until the buffer changes.
  GivenStep<Dim> step(double dt) const { return {dt, bodies, poses, velocities, spins, contacts}; }
};

}  // namespace talus
