#pragma once
// Who may sleep, who must wake.

#include <memory>
#include <vector>

#include "common/scene/scene.h"
#include "common/simulation/frame.h"

namespace talus {

/// A policy's answer for one frame: each entry names a body and its cause; `step` and `woke` are filled in by the
/// simulation.
struct Decision {
  std::vector<SleepEvent> freeze;
  std::vector<SleepEvent> thaw;
};

template <int Dim>
class SleepPolicy {
 public:
  virtual ~SleepPolicy() = default;

  /// Whether decide() does anything; without, piles are counted only for observers.
  virtual bool decides() const { return true; }

  /// Fills `decision` (empty on entry).
  virtual void decide(const Frame<Dim>& frame, Decision& decision) = 0;
};

/// The policy that the scene names. Throws std::invalid_argument for a name that none has.
template <int Dim>
std::unique_ptr<SleepPolicy<Dim>> make_policy(const Scene<Dim>& scene);

}  // namespace talus
