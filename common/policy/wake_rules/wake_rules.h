#pragma once
// What wakes bodies that feel no forces in their sleep.

#include <span>

#include "common/policy/wake_rules/impacts.h"
#include "common/policy/wake_rules/impacts_ahead.h"
#include "common/policy/wake_rules/local_avalanches.h"
#include "common/policy/wake_rules/sleep_ledger.h"
#include "common/policy/wake_rules/stability_checks.h"
#include "common/policy/wake_rules/support_loss.h"

namespace talus {

/// Where the contact solve knows no ring of sleeping bodies (SleepRing), it takes them for immovable: at the accuracy
/// `fast`, with the engines' own solvers and in worlds that talus does not simulate. These rules find what would have
/// moved them: an impact, a support that moves away, a heap that is too steep, or a load that no check has seen.
template <int Dim>
class WakeRules {
 public:
  explicit WakeRules(const RuleSetup<Dim>& setup);

  /// Whether update() may wake bodies although all sleep.
  bool may_wake_any() const { return checks_.may_begin(sleepers_); }
  /// After `rest` has seen the step.
  void update(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, RuleOutput<Dim>& out);
  /// Before `bodies` (awake, ascending) fall asleep.
  void note_falling_asleep(const RuleInput<Dim>& in, std::span<const BodyIndex> bodies);
  /// As SleepPolicy::note() and forget().
  void note(const World<Dim>& world, std::span<const SleepEvent> events);
  void forget(BodyIndex body);

  /// Whether an awake body takes part in a stability check and must stay awake.
  bool holds(BodyIndex body) const { return checks_.holds(body); }
  /// Whether a sleeping body rests on an awake one, and wakes once that moves away.
  bool rests_on_awake(const World<Dim>& world, BodyIndex sleeper) const {
    return support_loss_.watches(world, sleeper);
  }
  const StabilityChecks<Dim>& checks() const { return checks_; }
  /// The bodies that sleep, by the calls of note().
  const SleepLedger<Dim>& sleepers() const { return sleepers_; }

 private:
  ImpactsAhead<Dim> impacts_ahead_;
  Impacts<Dim> impacts_;
  SupportLoss<Dim> support_loss_;
  LocalAvalanches<Dim> avalanches_;
  StabilityChecks<Dim> checks_;
  SleepLedger<Dim> sleepers_;
};

}  // namespace talus
