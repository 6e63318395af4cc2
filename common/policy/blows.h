#pragma once
// Impacts on sleepers: whom they wake, and the momentum handed over.

#include <span>
#include <vector>

#include "common/policy/adaptive_params.h"
#include "common/policy/sleep_policy.h"
#include "common/world/world.h"

namespace talus {

/// A sleeper is a rock to the engine: what hits it is stopped as if by the whole earth. This finds the impacts in which
/// a free body in the sleeper's place would have been set in motion, and gives both partners the velocities that an
/// inelastic impact between free bodies leaves. The sleeper, awake from then on, passes the rest on to its neighbours
/// in the next steps: a blow goes as far as its momentum carries. A load that does not grow within a step is no blow.
///
/// What counts is how fast the point that was struck would move, since a blow off the centre topples a body that one at
/// its centre would only press down, and whence the blow comes. Of what can be told when a blow lands this best tells
/// who will be seen to move (docs/method.md).
template <int Dim>
class Blows {
 public:
  /// `extent` is D [m].
  Blows(const AdaptiveParams& params, double extent, const WorldDescription<Dim>& world);

  /// Appends the sleepers to wake, each once, ascending, and the velocities after the blows. To be called once a step.
  /// Costs O(contacts).
  void update(const World<Dim>& world, std::span<const Contact<Dim>> contacts, std::vector<BodyIndex>& hit,
              std::vector<Kick<Dim>>& kicks);

 private:
  /// What one awake body did to one sleeper in a step.
  struct Push {
    BodyIndex awake = 0;
    BodyIndex sleeper = 0;
    Vec<Dim> impulse = Vec<Dim>::Zero();  // on the awake one [N s]
    Vec<Dim> place = Vec<Dim>::Zero();    // mean of the points, weighted by impulse [m]
    double weight = 0.0;                  // sum of the points' normal impulses [N s]
    double approach = 0.0;                // fastest of the points' approach speeds [m/s]
  };
  /// A push as it would be between free bodies.
  struct Blow {
    Vec<Dim> impulse = Vec<Dim>::Zero();  // on the awake one [N s]
    double share = 0.0;                   // of the impulse that it would feel if the sleeper were free
    double speed = 0.0;  // that the sleeper would be given where it is struck, as far as it counts [m/s]
  };

  void gather(const BodyStates<Dim>& states, std::span<const Contact<Dim>> contacts);
  Blow blow(const BodyStates<Dim>& states, const Push& push) const;
  double growth(const Push& push, const Vec<Dim>& along, double awake_yields) const;
  void kick(const BodyStates<Dim>& states, BodyIndex body, const Vec<Dim>& place, const Vec<Dim>& impulse,
            std::vector<Kick<Dim>>& kicks) const;
  const Shape<Dim>& shape_of(const BodyStates<Dim>& states, BodyIndex body) const {
    return shapes_[static_cast<std::size_t>(states.shape[static_cast<std::size_t>(body)])];
  }

  double wake_speed_;  // [m/s]
  std::vector<Shape<Dim>> shapes_;
  std::vector<Push> pushes_;           // of this step, ascending by pair
  std::vector<Push> last_pushes_;      // of the step before
  std::vector<BodyIndex> last_awake_;  // who was awake then
  double fastest_approach_ = 0.0;      // of all contacts of this step [m/s]
};

}  // namespace talus
