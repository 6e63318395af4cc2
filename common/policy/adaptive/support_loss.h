#pragma once
// Sleeping bodies whose support moves away.

#include <algorithm>
#include <vector>

#include "common/policy/adaptive/rule.h"

namespace talus {

/// Wakes a sleeping body when an awake body that supports it, from below or from the side, has moved by more than
/// `support_slack`. The solver reports no force from a sleeping body, so lost support is detected by how far the
/// supporting contact has moved.
template <int Dim>
class SupportLoss {
 public:
  explicit SupportLoss(const RuleSetup<Dim>& setup);

  /// Costs O(contacts).
  void update(const RuleInput<Dim>& in, RuleOutput<Dim>& out);

  /// Whether an awake body supports this sleeping one.
  bool watches(BodyIndex sleeper) const {
    return std::ranges::find(contacts_, sleeper, &SupportContact::supported) != contacts_.end();
  }

  /// As SleepPolicy::forget().
  void forget(BodyIndex body);

 private:
  /// A contact by which an awake body supports a sleeping one.
  struct SupportContact {
    BodyIndex supporter = 0;
    BodyIndex supported = 0;
    Vec<Dim> point = Vec<Dim>::Zero();  // where the contact was first seen [m]
    Vec<Dim> local = Vec<Dim>::Zero();  // the same point in the supporter's own axes [m]
  };

  void forget_ended(const RuleInput<Dim>& in);
  void remember_new(const RuleInput<Dim>& in);

  double slack_;                              // [m]
  std::vector<SupportContact> contacts_;      // ascending by supporter, then supported
  std::vector<SupportContact> new_contacts_;  // scratch
};

}  // namespace talus
