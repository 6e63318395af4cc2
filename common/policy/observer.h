#pragma once

#include <span>
#include <string_view>

#include "common/policy/frame.h"

namespace talus {

/// Sees each finished frame. A recorder, the telemetry, a measure, a progress line.
template <int Dim>
class Observer {
 public:
  virtual ~Observer() = default;

  /// Whether on_frame() reads the contacts of the next step.
  virtual bool needs_contacts() const { return false; }

  /// Called in each step before the engine moves the bodies, once all that acts in the step is set.
  virtual void on_start(const World<Dim>& world) { (void)world; }
  /// Called in each step after the engine has moved the bodies and before any body falls asleep or wakes.
  /// World::contacts() are those of the step. `time`: of the end of the step [s].
  virtual void on_motion(const World<Dim>& world, double time) {
    (void)world;
    (void)time;
  }
  virtual void on_frame(const Frame<Dim>& frame) = 0;
  /// What one that watches for faults has found so far, one of each kind.
  virtual std::span<const Warning> warnings() const { return {}; }
  /// Called once, also when the run was stopped or failed; `reason`: "finished", "interrupted", or the error.
  virtual void on_end(const Frame<Dim>& last, std::string_view reason) {
    (void)last;
    (void)reason;
  }
};

}  // namespace talus
