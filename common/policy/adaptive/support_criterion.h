#pragma once
// Which resting bodies are supported by the ground, by sleeping bodies, or by each other.

#include <vector>

#include "common/policy/rest/rule.h"

namespace talus {

/// A body may sleep when at least half of its weight is carried by bodies at rest: ground, obstacles, sleeping bodies,
/// or others that fall asleep in the same step. Bodies that stay awake may carry at most `awake_share` of it. The
/// contact forces of one step give each supporter's share against gravity; that they balance is known from the body's
/// rest. Without gravity no body needs support.
template <int Dim>
class SupportCriterion {
 public:
  explicit SupportCriterion(const RuleSetup<Dim>& setup);

  /// Keeps of `candidates` (awake, ascending) those that are supported. Removes unsupported ones until the rest support
  /// each other. Costs O(contacts), and O(candidates) for each round of removals.
  void keep_supported(const RuleInput<Dim>& in, std::vector<BodyIndex>& candidates) const;

 private:
  double awake_share_;
};

}  // namespace talus
