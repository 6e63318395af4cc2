#pragma once
// How a program names the bodies of a sleeper.

#include <compare>
#include <cstdint>

namespace talus {

/// Names a body until it is removed. Slots are used again, and then have another generation, so a handle of a removed
/// body names no other one. The default names no body; in a contact it stands for all that never moves.
struct Handle {
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;  // from 1 on; 0: no body

  auto operator<=>(const Handle&) const = default;
};

/// A handle as one number; 0 is the default.
inline std::uint64_t number_of(Handle handle) { return (std::uint64_t{handle.generation} << 32U) | handle.slot; }
inline Handle handle_of(std::uint64_t number) {
  return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32U)};
}

/// What a sleeper may do with a body.
enum class BodyRole : std::uint8_t {
  sleeps,       // it sleeps when the policy decides so
  stays_awake,  // it never sleeps, since what moves it is unknown: joints, a motor, a player
  kinematic,    // the program moves it, and nothing pushes it: a platform, a door
};

}  // namespace talus
