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
/// lose motion as in honey, and more of it the more of the slope is missing. It holds nobody up: in a pile that is
/// steep enough everything moves freely.
template <int Dim>
class Steering {
 public:
  /// `extent` is D [m].
  Steering(const AdaptiveParams& params, double extent, const WorldDescription<Dim>& world);

  /// Slows bodies in one step, by new kicks or by shrinking those that are there; no body gets two. Costs O(contacts)
  /// and, twice a second, O(all bodies); without a pile to hold nothing.
  void update(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts, std::vector<Kick<Dim>>& kicks);

 private:
  struct Hold {
    double lasting = 0.0;  // what it has taken so far to keep the slope [1/s]
    double drag = 0.0;     // share of their motion that bodies lose [1/s]
  };

  void find_touching(const BodyStates<Dim>& states, std::span<const Contact<Dim>> contacts);
  void aim(const Pile<Dim>& pile, const BodyStates<Dim>& states, Hold& hold);
  double slope(const Pile<Dim>& pile, const BodyStates<Dim>& states);
  void slow(const Pile<Dim>& pile, double kept, const BodyStates<Dim>& states, std::vector<Kick<Dim>>& kicks) const;

  double dt_;
  double slow_;    // speed below which a body has found its place [m/s]
  double gain_;    // drag per slope missing [1/s]
  double growth_;  // of the lasting drag, per slope missing [1/s^2]
  double most_;    // drag [1/s]
  std::int64_t steps_between_looks_;
  std::vector<Hold> holds_;          // beside the piles
  std::vector<BodyIndex> touching_;  // scratch: awake, ascending
  std::vector<Vec<Dim>> places_;     // scratch
};

}  // namespace talus
