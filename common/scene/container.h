#pragma once

#include <vector>

#include "common/world/world_description.h"

namespace talus {

/// A box without a lid, made of upright walls.
template <int Dim>
struct ContainerParams {
  Vec<Dim> inner_size = Vec<Dim>::Ones();  // [m] > 0; the last: height of the walls
  double wall = 1.0;                       // their thickness [m] > 0; thin: fast bodies may go through in one step
  bool floor = false;                      // a slab under it as thick as the walls; without, the ground is the floor
};

/// The walls, each an obstacle. `pose`: middle of the inside's lower face.
template <int Dim>
std::vector<Obstacle<Dim>> container_walls(const ContainerParams<Dim>& params, const Pose<Dim>& pose,
                                           const Material& material);

}  // namespace talus
