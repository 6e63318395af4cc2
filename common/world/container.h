#pragma once
// Containers without a lid, made of obstacles.

#include <array>
#include <span>
#include <vector>

#include "common/params/field.h"
#include "common/world/world_description.h"

namespace talus {

inline constexpr Key wall_key = {.name = "wall",
                                 .unit = "m",
                                 .range = length_range,
                                 .meaning = "thickness. Thin: fast bodies go through it within one step"};
inline constexpr Key floor_key = {.name = "floor",
                                  .meaning = "a slab beneath as thick as the walls; without, the ground is the floor"};

/// A box of upright walls. container_fields has the unit, range and effect of each field.
template <int Dim>
struct ContainerParams {
  Vec<Dim> inner_size = Vec<Dim>::Ones();  // the last: height of the walls
  double wall = 1.0;
  bool floor = false;
};

template <int Dim>
inline constexpr auto container_fields = std::to_array<Field<ContainerParams<Dim>>>({
    {&ContainerParams<Dim>::inner_size,
     {.name = "inner_size",
      .required = true,
      .type = "lengths",
      .unit = "m",
      .range = length_range,
      .meaning = "inside, the last number the height of the walls"}},
    {&ContainerParams<Dim>::wall, wall_key},
    {&ContainerParams<Dim>::floor, floor_key},
});

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

/// Keys of an outline, of which one is given.
inline constexpr Key outline_radius_key = {.name = "radius",
                                           .required = true,
                                           .unit = "m",
                                           .range = length_range,
                                           .meaning = "of a cylinder of 32 walls that touch the circle"};
inline constexpr Key outline_corners_key = {.name = "corners",
                                            .required = true,
                                            .type = "points",
                                            .unit = "m",
                                            .range = coordinate_range,
                                            .meaning = "`[x, y]` of a convex polygon; each angle 5 degrees or more"};

inline constexpr auto convex_container_fields = std::to_array<Field<ConvexContainerParams>>({
    {{}, outline_radius_key},
    {{}, outline_corners_key},
    {&ConvexContainerParams::height,
     {.name = "height", .required = true, .unit = "m", .range = length_range, .meaning = "of the walls"}},
    {&ConvexContainerParams::wall, wall_key},
    {&ConvexContainerParams::floor, floor_key},
});

/// One wall for each side of the outline, joined on slanted cuts, and the floor. `pose`: where the outline's origin
/// goes, at the height of the inside's lower face. Throws InvalidValue for a sharp corner.
std::vector<Obstacle<3>> convex_container_walls(const ConvexContainerParams& params, const Pose<3>& pose,
                                                const Material& material);

/// Regular polygon of 32 sides around a circle, each of which touches it.
std::vector<Vec2> round_outline(double radius);

}  // namespace talus
