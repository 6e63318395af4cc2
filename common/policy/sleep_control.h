#pragma once
// What puts the bodies of a world to sleep and wakes them.

#include <memory>
#include <span>
#include <vector>

#include "common/policy/sleep_policy.h"

namespace talus {

/// Applies a policy to a world: counts its piles, has the policy decide, and carries out its decisions and the
/// caller's requests, in one place. Then it reports the changes to piles and policy. Bodies fall asleep and wake in no
/// other way.
template <int Dim>
class SleepControl {
 public:
  /// `world` must outlive this object. Where the parameters of a pile leave open whether bodies in flight count, the
  /// policy decides it. `engine_sleep`: the engine puts bodies to sleep and wakes them by itself, which becomes events
  /// too.
  SleepControl(World<Dim>& world, std::unique_ptr<SleepPolicy<Dim>> policy, std::vector<PileParams<Dim>> piles,
               const TypicalBody& typical, bool engine_sleep = false);

  const SleepPolicy<Dim>& policy() const { return *policy_; }
  const PileSet<Dim>& piles() const { return piles_; }
  /// Of the last finished step, by body.
  std::span<const SleepEvent> events() const { return events_; }
  /// What the policy decided in the last step, as far as it was carried out.
  const Decision<Dim>& decision() const { return decision_; }

  /// Whether counting the piles takes the contacts of a step.
  bool piles_need_contacts() const { return piles_.needs_contacts() || piles_.has_unplaced(); }

  /// Section 3.2. After a step of `dt` [s]. `recount`: all bodies, not only those awake.
  void count_piles(double dt, bool recount);
  /// Has the policy decide.
  void decide(const Frame<Dim>& frame);
  /// Carries out the decision, and ends step number `step`: the events since the last one are its events.
  void apply(std::int64_t step);
  /// Before a step: it has no events yet.
  void start_step() { events_.clear(); }

  /// Between two steps: puts those of the bodies to sleep that are awake. Returns what was done.
  std::vector<SleepEvent> freeze(std::span<const BodyIndex> bodies, SleepCause cause);
  /// Wakes those of the bodies that sleep and are in the world. Returns what was done.
  std::vector<SleepEvent> wake(std::span<const BodyIndex> bodies, SleepCause cause);
  std::vector<SleepEvent> wake_all(SleepCause cause);
  /// Takes bodies out of the world, each listed once.
  void remove(std::span<const BodyIndex> bodies);
  /// As SleepPolicy::forget().
  void forget(BodyIndex body);
  /// A body has touched something before.
  void note_touch(BodyIndex body) { piles_.note_touch(world_.states(), body); }

  /// Another policy from now on. A policy has no state of bodies that another one froze, so all wake.
  void switch_policy(std::unique_ptr<SleepPolicy<Dim>> policy);

 private:
  void place_pile();
  void change_sleep(std::vector<SleepEvent>& events, bool woke);
  void note(std::span<const SleepEvent> events);
  void note_engine_sleep();
  void close_events(std::int64_t step);

  World<Dim>& world_;
  std::unique_ptr<SleepPolicy<Dim>> policy_;
  PileSet<Dim> piles_;
  Decision<Dim> decision_;
  std::vector<BodyIndex> bodies_;           // scratch
  std::vector<SleepEvent> events_;          // of the last step
  std::vector<SleepEvent> new_events_;      // since the last step
  std::vector<std::uint8_t> known_asleep_;  // by body, as events tell; with the engine's own sleeping only
  bool engine_sleep_;
};

}  // namespace talus
