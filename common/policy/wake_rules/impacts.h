#pragma once
// Impacts on sleeping bodies: which bodies they wake, and the momentum they transfer.

#include <vector>

#include "common/policy/rest/rest_criterion.h"
#include "common/policy/rest/rule.h"

namespace talus {

/// The engine treats a sleeping body as immovable, so a body that hits it is stopped as if by the ground. This rule
/// finds the impacts that would have set a free body in motion, wakes the sleeping body, and gives both bodies the
/// velocities after an inelastic impact between free bodies. The woken body then hits its neighbours in the next steps,
/// so an impact spreads as far as its momentum carries it. A load that does not grow within a step is no impact.
///
/// The measure is the speed that the struck point would get, weighted by direction. It counts that an impact off the
/// centre topples a body. Of the quantities known when an impact lands it predicts best which bodies will move
/// (lab/notes/impact_rule.md).
template <int Dim>
class Impacts {
 public:
  explicit Impacts(const RuleSetup<Dim>& setup);

  /// Costs O(contacts).
  void update(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, RuleOutput<Dim>& out);

  /// As SleepPolicy::forget().
  void forget(BodyIndex body);

 private:
  /// The sum of one awake body's contacts with one sleeping body in a step.
  struct ContactImpulse {
    BodyIndex awake = 0;
    BodyIndex sleeper = 0;
    Vec<Dim> impulse = Vec<Dim>::Zero();  // on the awake body [N s]
    Vec<Dim> point = Vec<Dim>::Zero();    // mean of the contact points, weighted by normal impulse [m]
    double normal_impulse = 0.0;          // sum over the contact points [N s]
    double approach_speed = 0.0;          // largest of the contact points' [m/s]
  };
  /// The same impact as it would be between free bodies.
  struct Impact {
    Vec<Dim> impulse = Vec<Dim>::Zero();  // on the awake body, as the engine applied it [N s]
    double share = 0.0;                   // of that impulse if the sleeping body were free, in (0, 1)
    double speed = 0.0;                   // that the struck point would get, weighted by direction [m/s]
  };

  void collect(const RuleInput<Dim>& in);
  Impact evaluate(const RuleInput<Dim>& in, const RestCriterion<Dim>& rest, const ContactImpulse& contact) const;
  double increase(const RestCriterion<Dim>& rest, const ContactImpulse& contact, const Vec<Dim>& direction,
                  double awake_inverse_mass) const;

  double wake_height_;                         // to which the struck point of a body must be able to rise [m]
  std::vector<ContactImpulse> impulses_;       // of this step, ascending by pair
  std::vector<ContactImpulse> last_impulses_;  // of the last update
  double fastest_approach_ = 0.0;              // of all contacts of this step [m/s]
};

}  // namespace talus
