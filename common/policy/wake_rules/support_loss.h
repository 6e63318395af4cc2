#pragma once
// Sleeping bodies whose support moves away.

#include <span>
#include <vector>

#include "common/policy/rest/rule.h"

namespace talus {

/// Wakes a sleeping body when a body that supports it, from below or from the side, is awake and has moved by more than
/// `support_slack`. The solver reports no force from a sleeping body, so lost support is detected by how far the
/// supporting contact has moved. The motion counts from where the body fell asleep, over all times that its supporter
/// wakes and sleeps again: one that sinks a little each time would leave it behind.
template <int Dim>
class SupportLoss {
 public:
  explicit SupportLoss(const RuleSetup<Dim>& setup);

  /// Costs O(contacts) and O(supports by awake bodies).
  void update(const RuleInput<Dim>& in, RuleOutput<Dim>& out);
  /// Before `bodies` (awake, ascending) fall asleep: the contacts that lift them are their supports.
  void note_falling_asleep(const RuleInput<Dim>& in, std::span<const BodyIndex> bodies);

  /// Whether an awake body supports this sleeping one.
  bool watches(const World<Dim>& world, BodyIndex sleeper) const;

  /// A body woke: it has no supports until it sleeps again.
  void note_awake(BodyIndex body);
  /// As SleepPolicy::forget().
  void forget(BodyIndex body);

 private:
  /// A contact by which a body supports a sleeping one.
  struct Support {
    BodyIndex supported = 0;
    Vec<Dim> point = Vec<Dim>::Zero();  // where the contact was first seen [m]
    Vec<Dim> local = Vec<Dim>::Zero();  // the same point in the supporter's own axes [m]
  };

  void resize(const RuleInput<Dim>& in);
  void remember_new(const RuleInput<Dim>& in);
  void add(const RuleInput<Dim>& in, BodyIndex supporter, BodyIndex supported, const Vec<Dim>& point);

  double slack_;                                       // [m]
  std::vector<std::vector<Support>> supports_;         // [supporter]
  std::vector<std::vector<BodyIndex>> supporters_of_;  // [supported]
};

}  // namespace talus
