#pragma once
// A world with periodic sides.

#include <memory>

#include "common/world/world.h"

namespace talus {

/// What `make` makes of the description: as it is, or, if it has periodic sides, inside a world that has them. The
/// inner one has images of each body and each obstacle.
template <int Dim>
std::unique_ptr<World<Dim>> make_with_sides(const WorldDescription<Dim>& description, const WorldMaker<Dim>& make);

}  // namespace talus
