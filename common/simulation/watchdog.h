#pragma once

#include <span>

#include "common/policy/sleep_event.h"
#include "common/scene/scene.h"
#include "common/simulation/emitter.h"
#include "common/simulation/energy_ledger.h"
#include "common/simulation/overlap_watch.h"
#include "common/simulation/passing_watch.h"
#include "common/world/warning.h"
#include "common/world/world.h"

namespace talus {

/// Checks after each step for states that a correct run does not reach. Costs O(awake) and changes nothing.
template <int Dim>
class Watchdog {
 public:
  Watchdog(const Scene<Dim>& scene, const SpeedLimits& limits);

  /// Whether the step that will be number `step` must record its contacts, besides each in which an obstacle moves.
  bool needs_contacts(std::int64_t step) const { return overlap_.due(step); }

  /// Just before World::step(), once all that acts in the step is set.
  void start_step(const World<Dim>& world);
  /// Just after it; `step` is its number.
  void end_step(const World<Dim>& world, std::int64_t step);

  /// After a step and the policy's decision. `events` are those of the step.
  void check(const World<Dim>& world, std::span<const SleepEvent> events, std::int64_t step);

  /// After the last step.
  void finish(const Emitter<Dim>& emitter, std::int64_t step);

  /// One of each kind that was seen, in the order of first sight.
  std::span<const Warning> warnings() const { return warnings_.all(); }
  const RunOverlap& overlap() const { return overlap_.overlap(); }

 private:
  void check_place(const BodyStates<Dim>& states, BodyIndex body, std::int64_t step);
  void check_speed(const BodyStates<Dim>& states, BodyIndex body, std::int64_t step);
  void check_energy(const World<Dim>& world, std::int64_t step);

  EnergyLedger<Dim> ledger_;
  OverlapWatch<Dim> overlap_;
  PassingWatch<Dim> passing_;
  double lowest_;         // height that no centre may lie below [m]
  double farthest_;       // from the origin that a coordinate may be [m]
  double ground_;         // [m]
  double dt_;             // [s]
  double speed_squared_;  // from here on a speed is at the limit
  double spin_squared_;
  WarningList warnings_;
};

/// Bodies in the world with the centre below the ground or outside of the range of positions. Costs O(all bodies).
template <int Dim>
int bodies_lost(const BodyStates<Dim>& states, const Ground& ground, const UnitScale& units = {});

}  // namespace talus
