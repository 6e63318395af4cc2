#pragma once

#include "common/scene/table_reader.h"
#include "common/world/world_description.h"

namespace talus {

/// `[world]`: gravity, time step, solver.
template <int Dim>
void read_world(TableReader& table, WorldDescription<Dim>& world);

/// `[skip]`.
void read_skips(TableReader& table, Skips& skips);

/// `[ground]`.
void read_ground(TableReader& table, Ground& ground);

/// One `[[obstacle]]`, appended; a container is as many as it has walls.
template <int Dim>
void read_obstacle(TableReader& table, std::vector<Obstacle<Dim>>& obstacles);

}  // namespace talus
