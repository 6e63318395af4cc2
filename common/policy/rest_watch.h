#pragma once
// How long each awake body has been where it is.

#include <cstdint>
#include <span>
#include <vector>

#include "common/world/world.h"

namespace talus {

/// A body rests while no point of it has moved farther than a given distance from where its rest began. Distances tell
/// more than speeds: solver noise has speed but goes nowhere, and a slow creep adds up.
template <int Dim>
class RestWatch {
 public:
  /// `distance` and `distance_woken` [m] > 0, the latter for who proves that it lies where it slept; `shapes` as in the
  /// world.
  RestWatch(double distance, double distance_woken, const std::vector<Shape<Dim>>& shapes);

  /// To be called once a step. Costs O(awake).
  void update(std::int64_t step, const BodyStates<Dim>& states, std::span<const BodyIndex> awake);

  /// Of sleepers that wake now, those (ascending) that do because they will be hit later: they have not proved their
  /// rest.
  void expect_to_move(std::span<const BodyIndex> bodies);

  /// Steps since the rest of a body that is awake began; 0 for one that moves.
  std::int64_t steps_at_rest(std::int64_t step, BodyIndex body) const;

  /// Whether a body that is awake woke where it rests, and has strayed by no more than `distance_woken` since.
  bool slept_here(BodyIndex body) const;

 private:
  struct Anchor {
    BodyIndex body = 0;
    Pose<Dim> pose{};
    std::int64_t since = 0;  // step at which the rest began
    bool slept = false;      // it woke here, and has not strayed
  };

  const Anchor& anchor_of(BodyIndex body) const;

  double distance_;
  double distance_woken_;
  std::vector<double> reach_;         // [shape] farthest that a point lies from the centre of mass [m]
  std::vector<Anchor> anchors_;       // of the awake, ascending
  std::vector<Anchor> last_anchors_;  // of the step before
  std::int64_t last_step_ = -1;
  std::vector<BodyIndex> expected_;  // to move, of those that woke in the last step
  BodyIndex last_count_ = 0;         // bodies in the world the step before
};

/// No point within `reach` of the centre of mass moves farther than this [m] between two poses.
template <int Dim>
double farthest_move(const Pose<Dim>& from, const Pose<Dim>& to, double reach);

}  // namespace talus
