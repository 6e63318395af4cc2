#pragma once
// Box2D 2.4.1 behind the interface World.

#include <memory>

#include "common/world/engine_traits.h"
#include "common/world/world.h"

namespace talus {

/// A Box2D world. Throws std::invalid_argument on a bad description.
std::unique_ptr<World<2>> make_box2d_world(const WorldDescription<2>& description);

EngineTraits box2d_traits();

}  // namespace talus
