#pragma once
// Sleep body by body for a world that talus does not simulate.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/sleeper/body_traits.h"
#include "common/sleeper/given_step.h"
#include "common/sleeper/handle.h"
#include "common/sleeper/sleeper_options.h"

namespace talus {

/// Decides, step by step, which bodies of a foreign engine need not be simulated. After each step of the engine,
/// after_step() takes states and contacts of the bodies that are awake, and returns what to change. It works by policy
/// `adaptive` on one pile, whose place and slope it finds by itself.
///
/// Every function that returns SleepChanges has already counted them as done: the caller carries them out in its engine
/// before anything else, and they are valid until the next call. All arguments are in the program's axes. Bad input
/// throws InvalidValue and changes nothing. Costs follow the awake bodies, memory the most bodies there were at once.
template <int Dim>
class PileSleeper {
 public:
  /// `gravity` [m/s^2]. Throws InvalidValue on an option outside of its range.
  explicit PileSleeper(const Vec<Dim>& gravity, const SleeperOptions& options = {});
  ~PileSleeper();
  PileSleeper(PileSleeper&&) noexcept;
  PileSleeper& operator=(PileSleeper&&) noexcept;

  /// Adds a body, awake, at the pose of its centre of mass.
  Handle add(const BodyTraits<Dim>& traits, const Pose<Dim>& pose, BodyRole role = BodyRole::sleeps);
  /// Takes a body out. Sleeping bodies near it wake, since it may have supported them.
  const SleepChanges<Dim>& remove(Handle body);

  /// The bodies whose states after_step() needs: those awake and the kinematic ones. Valid until the next call.
  std::span<const Handle> followed() const;
  /// One decision. Call it after each step of the engine, substeps too.
  const SleepChanges<Dim>& after_step(const GivenStep<Dim>& step);

  /// Before something acts on a body: a force, a new velocity. Without effect on an awake one.
  const SleepChanges<Dim>& wake(Handle body);
  const SleepChanges<Dim>& wake_all();
  /// Wakes what sleeps near a box: where something that is no body of the sleeper came, went or exploded.
  const SleepChanges<Dim>& wake_near(const Box<Dim>& box);
  /// After the program has put a body elsewhere: it wakes, with the bodies near its old and its new place.
  const SleepChanges<Dim>& moved(Handle body, const Pose<Dim>& to);
  /// From the next step on [m/s^2]. If it differs from before by more than a hundredth, all bodies wake.
  const SleepChanges<Dim>& set_gravity(const Vec<Dim>& gravity);

  /// Whether the handle names a body that is there.
  bool has(Handle body) const;
  bool asleep(Handle body) const;
  /// Bodies that are there; kinematic ones count.
  int size() const;
  int awake() const;

  /// Of every body that is not kinematic, in the order of their slots.
  std::vector<SavedSleep> snapshot() const;
  /// Puts to sleep again what slept, and wakes all others. Before it, the bodies must be in their saved places; `poses`
  /// has them, entry i of saved[i]. A program that has added its bodies anew replaces their handles in `saved`.
  const SleepChanges<Dim>& restore(std::span<const SavedSleep> saved, std::span<const Pose<Dim>> poses);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace talus
