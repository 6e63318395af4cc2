#pragma once
// Sleeping bodies that wake before an impact reaches them.

#include <cstdint>
#include <vector>

#include "common/policy/rest/rule.h"

namespace talus {

/// The rule for impacts takes effect one step late, and one body at a time. This suffices for impacts from above, which
/// supports take up. It does not suffice where a body drives many others before it, or where bodies in contact push on
/// together: a sleeping body then stops them all like a fixed obstacle. So two kinds of bodies wake the sleeping bodies
/// in their path before the impact: a body with the momentum to drive many others, which also wakes as many around
/// these as it could set in motion; and a body that other awake bodies push to the side, for what lies on that side
/// and would wake when hit by a body of its mass and speed.
template <int Dim>
class ImpactsAhead {
 public:
  explicit ImpactsAhead(const RuleSetup<Dim>& setup);

  /// Costs O(awake + contacts), and a box query or a few for each body that is fast enough.
  void update(const RuleInput<Dim>& in, RuleOutput<Dim>& out);

 private:
  void add_pushes(const RuleInput<Dim>& in);
  void clear_pushes(const RuleInput<Dim>& in);
  void find_path(const RuleInput<Dim>& in, BodyIndex body);
  void wake_path(const RuleInput<Dim>& in, BodyIndex body, RuleOutput<Dim>& out);
  void wake_driven(const RuleInput<Dim>& in, BodyIndex body, RuleOutput<Dim>& out);

  double wake_height_;                 // to which the struck point of a body must be able to rise [m]
  double wake_speed_ = 0.0;            // speed for that in the gravity of this step [m/s]
  double heavy_mass_;                  // that an impact must be able to move [kg]
  std::vector<Vec<Dim>> pushes_;       // [body] scratch, all 0 between calls: impulse from awake bodies [N s]
  std::vector<BodyIndex> path_;        // scratch
  std::vector<BodyIndex> next_ring_;   // scratch
  std::vector<BodyIndex> woken_;       // scratch
  std::vector<std::uint8_t> reached_;  // [body] scratch, all 0 between calls
};

}  // namespace talus
