#pragma once
// What goes into a sleeper after a step of an engine, and what comes out. In the program's axes.

#include <span>
#include <vector>

#include "common/math/vector.h"
#include "common/policy/sleep_event.h"
#include "common/sleeper/handle.h"

namespace talus {

/// A contact point of a body after a step. Points between two sleeping bodies mean nothing and may be left out.
template <int Dim>
struct GivenContact {
  Handle a;
  Handle b;                                      // the default: something that never moves
  Vec<Dim> point = Vec<Dim>::Zero();             // [m]
  Vec<Dim> normal = Vec<Dim>::Zero();            // unit, from b to a; with the wrong sign, nothing sleeps
  double normal_impulse = 0.0;                   // [N s] over the step, >= 0
  Vec<Dim> friction_impulse = Vec<Dim>::Zero();  // [N s] over the step, on a
  double approach_speed = 0.0;                   // [m/s] at which the two came together before the step, >= 0
  double depth = 0.0;                            // [m], positive where they overlap
};

/// The result of one step of an engine. `bodies` has each of PileSleeper::followed() once, in any order, and may have
/// sleeping ones, of which then is checked that they stayed where they are. Entry i of the other spans belongs to
/// bodies[i].
template <int Dim>
struct GivenStep {
  double dt = 0.0;  // [s] > 0; may differ from step to step
  std::span<const Handle> bodies;
  std::span<const Pose<Dim>> poses;      // of the centres of mass
  std::span<const Vec<Dim>> velocities;  // of the centres of mass [m/s]
  std::span<const Spin<Dim>> spins;      // [rad/s]
  std::span<const GivenContact<Dim>> contacts;
};

/// A body that falls asleep or wakes, and why.
struct SleepChange {
  Handle body;
  SleepCause cause = SleepCause::user;
};

/// A new velocity of a body that is awake.
template <int Dim>
struct GivenVelocity {
  Handle body;
  Vec<Dim> velocity = Vec<Dim>::Zero();  // of the centre of mass [m/s]
  Spin<Dim> spin = Spin<Dim>::Zero();    // [rad/s]
  SleepCause cause = SleepCause::momentum;
};

/// What the program must do in its engine at once, in this order: make bodies movable again, at rest; set velocities;
/// stop bodies and make them immovable.
template <int Dim>
struct SleepChanges {
  std::vector<SleepChange> thaw;
  std::vector<GivenVelocity<Dim>> velocities;
  std::vector<SleepChange> freeze;
};

/// What a saved program must keep of a body so that it sleeps again.
struct SavedSleep {
  Handle body;
  bool asleep = false;   // and not on an awake body, since how far that has moved away is not kept
  bool settled = false;  // asleep, and no stability check is to come
};

}  // namespace talus
