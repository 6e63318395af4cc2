#pragma once
// Piles steeper than their bodies would make them.

#include <cstdint>
#include <span>
#include <vector>

#include "common/policy/adaptive_params.h"
#include "common/policy/sleep_policy.h"

namespace talus {

/// Holds each pile for which the scene asks so to its slope alpha (section 3.1: "set by the user"). Friction cannot:
/// what falls on a steep pile knocks it down, and what it knocks off rolls away. So bodies that touch something there
/// lose motion as in honey, and more of it the more of the slope is missing. It holds nobody up: what is left of the
/// drag at the slope asked for is what it takes to keep it, and in a pile some degrees steeper everything moves freely.
template <int Dim>
class Steering {
 public:
  /// `extent` is D [m].
  Steering(const AdaptiveParams& params, double extent, const WorldDescription<Dim>& world);

  /// Slows bodies in one step, by new kicks or by shrinking those that are there; no body gets two. A body belongs to
  /// its nearest pile. Costs O(contacts) and, twice a second, O(all bodies); without a pile to hold nothing.
  void update(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts, std::vector<Kick<Dim>>& kicks);

 private:
  struct Hold {
    double lasting = 0.0;  // what it has taken so far to keep the slope [1/s]
    double drag = 0.0;     // rate at which bodies lose motion [1/s]
  };
  /// An awake body that touches something and belongs to a pile that is held.
  struct Touching {
    BodyIndex body = 0;
    std::size_t pile = 0;
  };

  void find_touching(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts);
  void aim(const Frame<Dim>& frame, std::size_t pile);
  void find_places(const Frame<Dim>& frame, std::size_t pile);
  void slow(const BodyStates<Dim>& states, std::vector<Kick<Dim>>& kicks) const;

  double dt_;
  double resting_speed_;  // of bodies that have found their place, at most [m/s]
  double gain_;           // drag per slope missing [1/s]
  double growth_;         // of the lasting drag, per slope missing [1/s^2]
  double most_;           // drag [1/s]
  std::int64_t steps_between_looks_;
  std::vector<Hold> holds_;         // beside the piles
  std::vector<Touching> touching_;  // scratch, ascending
  std::vector<BodyIndex> bodies_;   // scratch
  std::vector<Vec<Dim>> places_;    // scratch: of bodies from the middle of their pile's base
};

}  // namespace talus
