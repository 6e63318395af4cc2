#pragma once
// Containers in scene files: around a pile, and as obstacles.

#include <vector>

#include "common/pile/boundary.h"
#include "common/scene/table_reader.h"
#include "common/world/world_description.h"

namespace talus {

/// The walls of an obstacle of kind "container".
template <int Dim>
std::vector<Obstacle<Dim>> read_container(TableReader& table, const Pose<Dim>& pose, const Material& material);

/// `[pile.boundary]`, the walls around a pile's middle. Where it asks for them, they are appended to the obstacles too.
template <int Dim>
Boundary<Dim> read_boundary(TableReader& table, const Vec<Dim>& at, std::vector<Obstacle<Dim>>& obstacles);

}  // namespace talus
