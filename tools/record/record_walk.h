#pragma once
// A record from its beginning to its end, holding one state at a time.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/pile/pile.h"
#include "common/policy/sleep_event.h"
#include "common/scene/happened.h"
#include "common/scene/scene.h"
#include "common/world/warning.h"
#include "lcmtypes/log_reader.h"

namespace talus {

/// A frame of output of a record.
template <int Dim>
struct RecordedFrame {
  std::int64_t step = 0;
  double time = 0.0;  // [s] simulated
  /// Velocities are zero.
  const BodyStates<Dim>& states;
  /// Per body of `states`: whether damage left its pose unknown.
  std::span<const std::uint8_t> unknown;
  /// Per body of `states`: why it last fell asleep or woke, as SleepCause; -1: it did neither yet.
  std::span<const std::int8_t> cause;
  /// Since the frame before.
  std::span<const SleepEvent> events;
  std::span<const Pile<Dim>> piles = {};
  /// All so far, one of each kind.
  std::span<const Warning> warnings = {};
  double kinetic_energy = 0.0;  // [J]
  /// Mean distance that the sleeping bodies are expected to move once all are woken [D]; -1: not known.
  double drift_estimate = -1.0;
  /// Of the scene, all so far.
  std::span<const DoneEvent> scene_events = {};

  /// Whether the body is in the world, at a known pose.
  bool shows(BodyIndex body) const { return states.removed[body] == 0 && unknown[body] == 0; }
};

/// What a walk had to leave out.
struct WalkDamage {
  std::uint64_t bytes = 0;       // that are no message
  std::int64_t undecodable = 0;  // messages whose checksum holds and that are of another kind all the same

  bool none() const { return bytes == 0 && undecodable == 0; }
};

/// The run's identity and end, from the record; printable. Empty where no message has it.
struct RecordedIdentity {
  std::string backend;
  std::string policy;
  std::string version;  // of talus that made the run
  std::string reason;   // why it ended; empty: it was killed
};

struct WalkResult {
  WalkDamage damage;
  RecordedIdentity run;
};

/// Calls `visit` with each frame of output in order. Throws std::invalid_argument where the record is not of `scene`.
template <int Dim>
WalkResult walk_record(const Scene<Dim>& scene, LogReader& log,
                       const std::function<void(const RecordedFrame<Dim>&)>& visit);

}  // namespace talus
