#pragma once
// Bullet 3.24 (single precision) behind the interface World.

#include <memory>

#include "common/world/engine_traits.h"
#include "common/world/world.h"

namespace talus {

/// A Bullet world in 3D. Throws std::invalid_argument on a bad description, and where gravity
/// would press a heap into the ground.
std::unique_ptr<World<3>> make_bullet_world(const WorldDescription<3>& description);

/// A Bullet world whose bodies stay in the x-z plane: the same scenes as Box2D, on the other engine. Shapes get a
/// depth along y that matters to nothing; masses and inertias are those of the 2D shapes.
std::unique_ptr<World<2>> make_bullet_planar_world(const WorldDescription<2>& description);

EngineTraits bullet_traits();
EngineTraits bullet_planar_traits();

}  // namespace talus
