#pragma once
// Impacts that set many bodies in motion at once.

#include <cstdint>
#include <vector>

#include "common/policy/adaptive/rule.h"

namespace talus {

/// Impacts spread by one body a step, which is too slow for a body that drives many others before it. So a body with
/// that much momentum wakes the sleeping bodies in its path before it arrives, and around them as many as it could set
/// in motion.
template <int Dim>
class HeavyImpacts {
 public:
  explicit HeavyImpacts(const RuleSetup<Dim>& setup);

  /// Costs O(awake), and a few box queries for each body whose momentum is large enough.
  void update(const RuleInput<Dim>& in, RuleOutput<Dim>& out);

 private:
  void wake_ahead(const RuleInput<Dim>& in, BodyIndex body, RuleOutput<Dim>& out);

  double wake_speed_;                  // [m/s]
  double heavy_mass_;                  // that an impact must be able to move [kg]
  double dt_;                          // [s]
  std::vector<BodyIndex> ring_;        // scratch
  std::vector<BodyIndex> next_ring_;   // scratch
  std::vector<BodyIndex> woken_;       // scratch
  std::vector<std::uint8_t> reached_;  // [body] scratch, all 0 between calls
};

}  // namespace talus
