#pragma once
// talus_shapes: one shape of bodies, or one obstacle.

#include <span>
#include <string_view>
#include <vector>

#include "common/world/world_description.h"
#include "lcmtypes/channels.h"

namespace talus {

/// All shapes of bodies, then all obstacles, one message each. Throws std::invalid_argument when a shape has so many
/// corners that it does not fit one message.
template <int Dim>
std::vector<talus_lcm::talus_shapes> to_shapes(std::span<const Shape<Dim>> shapes,
                                               std::span<const Obstacle<Dim>> obstacles);
template <int Dim>
std::vector<talus_lcm::talus_shapes> to_shapes(const WorldDescription<Dim>& world) {
  return to_shapes<Dim>(world.shapes, world.obstacles);
}

/// Puts an obstacle elsewhere.
template <int Dim>
void set_pose(const Pose<Dim>& pose, talus_lcm::talus_shapes& message);

/// The shape of a message that decode() took. Throws std::invalid_argument on what is no shape.
template <int Dim>
Shape<Dim> to_shape(const talus_lcm::talus_shapes& message);
/// The pose of its obstacle.
template <int Dim>
Pose<Dim> pose_of(const talus_lcm::talus_shapes& message);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_shapes& message);

}  // namespace talus
