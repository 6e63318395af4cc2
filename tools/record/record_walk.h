#pragma once
// A record from its beginning to its end, holding one state at a time.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/policy/sleep_event.h"
#include "common/scene/scene.h"
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

  /// Whether the body is in the world, at a known pose.
  bool shows(BodyIndex body) const { return states.removed[body] == 0 && unknown[body] == 0; }
};

/// What a walk had to leave out.
struct WalkDamage {
  std::uint64_t bytes = 0;       // that are no message
  std::int64_t undecodable = 0;  // messages whose checksum holds and that are of another kind all the same

  bool none() const { return bytes == 0 && undecodable == 0; }
};

/// Calls `visit` with each frame of output in order. Throws std::invalid_argument where the record is not of `scene`.
template <int Dim>
WalkDamage walk_record(const Scene<Dim>& scene, LogReader& log,
                       const std::function<void(const RecordedFrame<Dim>&)>& visit);

}  // namespace talus
