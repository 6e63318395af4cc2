#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/body.h"

namespace talus {

/// Why a body fell asleep or woke. The numbers are those of talus_sleep.lcm.
enum class SleepCause : std::uint8_t {
  score,         // rho d v above tau (section 3.3)
  rest,          // at rest for long enough and supported
  avalanche,     // its pile has an overfull layer (section 3.4); with `adaptive`, its part of the heap is too steep
  momentum,      // an impact on its pile (section 3.4); with `adaptive`, on itself
  lost_support,  // its support moved away
  engine,        // the engine's own rule
  user,          // the user's request
  check,         // with `adaptive`, its region is checked for stability
  motion,        // with `adaptive` and rings, forces move it
};

/// The largest number of a cause.
inline constexpr int last_cause = static_cast<int>(SleepCause::motion);

std::string_view to_string(SleepCause cause);

/// By number.
std::vector<std::string> cause_names();

/// One body falling asleep or waking.
struct SleepEvent {
  std::int64_t step = 0;
  BodyIndex body = 0;
  std::int32_t pile = -1;   // -1: no pile
  std::int32_t layer = -1;  // -1: in no layer
  bool woke = false;
  SleepCause cause = SleepCause::user;
  double score = 0.0;  // rho d v at the decision; 0 if no score was involved
};

}  // namespace talus
