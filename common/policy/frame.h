#pragma once
// One finished step, as policies and observers see it.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "common/pile/pile_set.h"
#include "common/policy/sleep_event.h"
#include "common/world/done_event.h"
#include "common/world/warning.h"
#include "common/world/world.h"

namespace talus {

/// Where the time of one step, or of several, went [s].
struct PhaseTimes {
  double emit = 0.0;
  double step = 0.0;
  double collide = 0.0;
  double solve = 0.0;
  double read = 0.0;
  double count = 0.0;
  double decide = 0.0;
  double apply = 0.0;
  double observe = 0.0;

  double total() const { return emit + step + count + decide + apply + observe; }
};

/// A part of a step, with its name in files.
struct Phase {
  std::string_view name;
  std::string_view meaning;
  double PhaseTimes::*time;
};

inline constexpr std::array<Phase, 9> all_phases = {{
    {"emit", "adding bodies", &PhaseTimes::emit},
    {"step", "the engine's step", &PhaseTimes::step},
    {"collide", "of it: finding contacts", &PhaseTimes::collide},
    {"solve", "of it: solving and moving", &PhaseTimes::solve},
    {"read", "of it: copying states out", &PhaseTimes::read},
    {"count", "counting piles", &PhaseTimes::count},
    {"decide", "the policy", &PhaseTimes::decide},
    {"apply", "freezing and thawing", &PhaseTimes::apply},
    {"observe", "observers of the step before", &PhaseTimes::observe},
}};

inline PhaseTimes& operator+=(PhaseTimes& sum, const PhaseTimes& more) {
  for (const Phase& phase : all_phases) sum.*phase.time += more.*phase.time;
  return sum;
}

/// Depth from which on the overlap of a pair counts as a fault [D].
inline constexpr double overlap_limit = 0.1;

/// What a run has shown of overlap so far.
struct RunOverlap {
  double deepest = 0.0;  // overlap of a pair that lasted [D]
  double share = 0.0;  // of the pairs in contact, over all samples: those whose overlap lasted at overlap_limit or more
};

template <int Dim>
class SleepPolicy;

/// References are valid during the call that hands the frame over.
template <int Dim>
struct Frame {
  std::int64_t step = 0;  // steps done, 1 after the first
  double time = 0.0;      // simulated [s]
  const World<Dim>& world;
  const PileSet<Dim>& piles;
  std::span<const SleepEvent> events;  // of this step, by body; empty while a policy decides, which note() tells
  PhaseTimes phases;
  std::span<const Warning> warnings = {};          // one of each kind that the run has shown so far, if it is observed
  int bodies_planned = 0;                          // of the scene in all
  const SleepPolicy<Dim>* policy = nullptr;        // that of the run
  std::span<const DoneEvent> done_events = {};     // of the scene, so far
  std::size_t done_now = 0;                        // of these, just before this step: the last ones
  std::optional<double> probed_drift = {};         // [D] of the last state of a run, once a probe has found it
  RunOverlap overlap = {};                         // that the run has shown so far, if it is observed
  std::function<bool(BodyIndex)> kept_awake = {};  // awake bodies that must stay so; empty: none

  /// Whether the run leaves it to the policy if an awake body falls asleep: one that is pulled, touches an obstacle
  /// that moves or feels another gravity than a moment ago must first follow.
  bool may_sleep(BodyIndex body) const { return !kept_awake || !kept_awake(body); }
};

}  // namespace talus
