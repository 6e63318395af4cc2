#pragma once
// One finished step, as policies and observers see it.

#include <cstdint>
#include <span>

#include "common/pile/pile_set.h"
#include "common/policy/phase_times.h"
#include "common/policy/sleep_event.h"
#include "common/world/warning.h"
#include "common/world/world.h"

namespace talus {

/// References are valid during the call that hands the frame over.
template <int Dim>
struct Frame {
  std::int64_t step = 0;  // steps done, 1 after the first
  double time = 0.0;      // simulated [s]
  const World<Dim>& world;
  const PileSet<Dim>& piles;
  std::span<const SleepEvent> events;  // of this step, by body; empty while a policy decides
  PhaseTimes phases;
  std::span<const Warning> warnings = {};  // one of each kind that the run has shown so far, if it is observed
  int bodies_asked = 0;                    // that the scene's sources add in all
};

}  // namespace talus
