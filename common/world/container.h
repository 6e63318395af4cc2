#pragma once
// Containers without a lid, made of obstacles.

#include <vector>

#include "common/world/world_description.h"

namespace talus {

/// A box of upright walls. container_fields has the unit, range and effect of each field.
template <int Dim>
struct ContainerParams {
  Vec<Dim> inner_size = Vec<Dim>::Ones();  // the last: height of the walls
  double wall = 1.0;
  bool floor = false;
};

/// The walls, each an obstacle. `pose`: middle of the inside's lower face.
template <int Dim>
std::vector<Obstacle<Dim>> container_walls(const ContainerParams<Dim>& params, const Pose<Dim>& pose,
                                           const Material& material);

/// A container whose inside is the same convex polygon at all heights.
struct ConvexContainerParams {
  std::vector<Vec2> outline;  // of the inside, in x and y [m]: corners of a convex polygon, counter-clockwise
  double height = 1.0;
  double wall = 1.0;
  bool floor = false;
};

/// One wall for each side of the outline, joined on slanted cuts, and the floor. `pose`: where the outline's origin
/// goes, at the height of the inside's lower face. Throws InvalidValue for a sharp corner.
std::vector<Obstacle<3>> convex_container_walls(const ConvexContainerParams& params, const Pose<3>& pose,
                                                const Material& material);

/// Regular polygon of 32 sides around a circle, each of which touches it.
std::vector<Vec2> round_outline(double radius);

}  // namespace talus
