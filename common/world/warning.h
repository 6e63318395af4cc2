#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/body.h"

namespace talus {

/// A kind of state that a correct run does not reach. TALUS_STATS has all but `drift`, which is measured after the run.
enum class WarningKind : std::uint8_t {
  below_ground,   // a centre of mass below the ground plane
  outside_world,  // a centre of mass beyond the coordinates that positions are resolved at
  energy,         // more energy than sources, gravity and the policy gave
  speed_limit,    // a body as fast as the engine moves one
  spin_limit,     // a body that turns as fast as the engine turns one
  not_appeared,   // bodies that were due and found no free place until the end
  overlap,        // a body that lies deep in another one, in the ground or in an obstacle
  passed,         // a body that got through another one or an obstacle, or deep into it, within a step
  drift,          // sleeping bodies that move farther than the tolerance once woken, where that is measured
};

/// The name in files: "below_ground", ...
std::string_view to_string(WarningKind kind);

/// What a run has shown of one kind.
struct Warning {
  WarningKind kind = WarningKind::below_ground;
  std::int64_t step = 0;    // the first
  BodyIndex body = -1;      // the first; of `energy` the one with the most kinetic energy then; -1: none
  std::int64_t bodies = 0;  // different ones so far; of `energy` those awake at the first step
  double value = 0.0;  // the largest so far: depth of the centre [m], coordinate [m], energy gained [J], speed [m/s],
                       // spin [rad/s], number of bodies, depth of overlap [D],
                       // way within the step, relative to the other body [m], mean drift [D]
};

/// What a run has shown, one warning of each kind in the order of first sight.
class WarningList {
 public:
  /// A body shows a fault of this kind. The warning keeps the first step and body, and the largest value.
  void note(WarningKind kind, BodyIndex body, std::int64_t step, double value);
  /// A warning of a kind that is found once in a run.
  void add(const Warning& warning) { warnings_.push_back(warning); }
  Warning* find(WarningKind kind);
  std::span<const Warning> all() const { return warnings_; }

 private:
  std::vector<Warning> warnings_;
  std::vector<std::uint8_t> seen_;  // by body: bit k for kind k; empty until the first warning
};

/// First step, body, value, and what to change in the scene; one line without end.
std::string advice(const Warning& warning);

/// How many bodies, since when, and the largest value; one line without end.
std::string account(const Warning& warning);

}  // namespace talus
