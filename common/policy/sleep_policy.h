#pragma once
// Who may sleep, who must wake.

#include <memory>
#include <vector>

#include "common/scene/scene.h"
#include "common/simulation/frame.h"

namespace talus {

/// A new velocity for a body that is awake or woken by the same decision.
template <int Dim>
struct Kick {
  BodyIndex body = 0;
  Vec<Dim> velocity = Vec<Dim>::Zero();  // of the centre of mass [m/s]
  Spin<Dim> spin = Spin<Dim>::Zero();    // [rad/s]
};

/// A policy's answer for one frame: each event names a body and its cause; `step` and `woke` are filled in by the
/// simulation.
template <int Dim>
struct Decision {
  std::vector<SleepEvent> freeze;
  std::vector<SleepEvent> thaw;
  std::vector<Kick<Dim>> kicks;  // in force once the bodies to thaw are awake
};

template <int Dim>
class SleepPolicy {
 public:
  virtual ~SleepPolicy() = default;

  /// Whether decide() does anything; without, piles are counted only for observers.
  virtual bool decides() const { return true; }

  /// Whether bodies that have touched nothing yet count in layers, for piles that do not say.
  virtual bool counts_flying() const { return true; }

  /// Fills `decision` (empty on entry).
  virtual void decide(const Frame<Dim>& frame, Decision<Dim>& decision) = 0;
};

/// The policy that the scene names. Throws std::invalid_argument for a name that none has.
template <int Dim>
std::unique_ptr<SleepPolicy<Dim>> make_policy(const Scene<Dim>& scene);

}  // namespace talus
