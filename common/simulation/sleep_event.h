#pragma once

#include <cstdint>
#include <string_view>

#include "common/world/body.h"

namespace talus {

/// Why a body fell asleep or woke.
enum class SleepCause : std::uint8_t {
  score,         // rho d v above tau (section 3.3)
  rest,          // slow and supported for long enough
  avalanche,     // its pile has an overfull layer (section 3.4), or with `adaptive` its part of the heap is steep
  momentum,      // something hit its pile hard (section 3.4)
  lost_support,  // what it rested on left
  growth,        // its pile's layers changed
  merge,         // its pile became one with another
  engine,        // the engine's own rule
  user,          // asked for from outside
};

std::string_view to_string(SleepCause cause);

/// One body falling asleep or waking.
struct SleepEvent {
  std::int64_t step = 0;
  BodyIndex body = 0;
  std::int32_t pile = -1;   // -1: no pile
  std::int32_t layer = -1;  // -1: in no layer
  bool woke = false;
  SleepCause cause = SleepCause::user;
  double score = 0.0;  // rho d v when decided; 0 where no score was involved
};

}  // namespace talus
