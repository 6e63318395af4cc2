#pragma once
// Engine states as ours.

#include <box2d/box2d.h>

#include <optional>
#include <span>

#include "common/world/body.h"

namespace talus::box2d {

/// What the engine knows of one of our bodies: awake, a body of its own; frozen, fixtures of a shared host; else
/// nothing.
struct EngineBody {
  b2Body* body = nullptr;
  b2Fixture* frozen = nullptr;  // the first of them
};

/// The first of `awake` whose state in the engine is NaN or infinite.
std::optional<BodyIndex> first_not_finite(std::span<const EngineBody> bodies, std::span<const BodyIndex> awake);

/// Copies the poses and velocities of `awake` from the engine.
void read_states(std::span<const EngineBody> bodies, std::span<const BodyIndex> awake, BodyStates<2>& states);

}  // namespace talus::box2d
