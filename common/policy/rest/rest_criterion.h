#pragma once
// How long each awake body has been at rest.

#include <cstdint>
#include <vector>

#include "common/policy/rest/rule.h"

namespace talus {

/// A body is at rest while no point of it has moved farther than `rest_distance` from where its rest began. Distance is
/// a better measure than speed: the solver's noise has speed but goes nowhere, and a slow creep adds up. A body that
/// woke and has stayed within `rest_distance_woken` is marked as unmoved, since it has been at rest before.
template <int Dim>
class RestCriterion {
 public:
  /// Where and when a body's rest began.
  struct Reference {
    BodyIndex body = 0;
    Pose<Dim> pose{};
    double since = 0.0;  // on the clock of time() [s]
    bool unmoved_since_wake = false;
  };

  explicit RestCriterion(const RuleSetup<Dim>& setup);

  /// Costs O(awake).
  void update(const RuleInput<Dim>& in);

  /// As SleepPolicy::forget().
  void forget(BodyIndex body);

  /// Bodies in `wakes` whose impact is still to come are not marked as unmoved when they wake.
  void expect_motion(const WakeList& wakes);

  /// Of the bodies that the last update() found awake, ascending.
  std::span<const Reference> references() const { return references_; }
  /// Sum of the steps that update() saw [s].
  double time() const { return time_; }
  /// How far a body at rest may have moved [m].
  double distance() const { return distance_; }

  /// Whether the last update() found the body awake.
  bool watches(BodyIndex body) const;
  /// Whether it was awake after the step before too.
  bool was_awake(BodyIndex body) const;

  /// Time since the rest of an awake body began [s]; 0 for a body that moves.
  double time_at_rest(BodyIndex body) const;

  /// Whether an awake body woke where it rests and has stayed within `rest_distance_woken` since.
  bool unmoved_since_wake(BodyIndex body) const;

 private:
  const Reference& reference_of(BodyIndex body) const;

  double distance_;                         // [m]
  double distance_woken_;                   // [m]
  std::vector<Reference> references_;       // of the awake bodies, ascending
  std::vector<Reference> last_references_;  // of the step before
  std::int64_t last_step_ = -1;
  double time_ = 0.0;
  std::vector<BodyIndex> expected_to_move_;  // of the bodies that the last step woke, ascending
  BodyIndex last_count_ = 0;                 // bodies in the world in the last step
};

/// Upper bound of the distance [m] that any point within `reach` [m] of the centre of mass moves between two poses.
template <int Dim>
double max_displacement(const Pose<Dim>& from, const Pose<Dim>& to, double reach);

}  // namespace talus
