#pragma once

#include <span>
#include <vector>

#include "common/pile/boundary.h"
#include "common/world/world_description.h"

namespace talus {

/// A container without a lid whose inside is the same convex polygon at all heights: what container_walls() cannot do.
struct ConvexContainerParams {
  std::vector<Vec2> outline;  // of the inside, in x and y [m]: corners of a convex polygon, counter-clockwise
  double height = 1.0;        // of the walls [m] > 0
  double wall = 1.0;          // their thickness [m] > 0; thin: fast bodies may go through in one step
  bool floor = false;         // a slab under it as thick as the walls; without, the ground is the floor
};

/// One wall for each side of the outline, joined on slanted cuts, and the floor. `pose`: where the outline's origin
/// goes, at the height of the inside's lower face.
std::vector<Obstacle<3>> convex_container_walls(const ConvexContainerParams& params, const Pose<3>& pose,
                                                const Material& material);

/// Regular polygon of 32 sides around a circle, each of which touches it.
std::vector<Vec2> round_outline(double radius);

/// The same walls for a pile whose centre is the outline's origin, which must lie inside: std::invalid_argument.
Boundary<3> convex_boundary(std::span<const Vec2> outline, double rim);

}  // namespace talus
