#pragma once
// What does not move in scene files: obstacles, containers, and the walls around a pile.

#include <array>
#include <optional>
#include <vector>

#include "common/pile/boundary.h"
#include "common/scene/read_shape.h"
#include "common/scene/scene_fields.h"
#include "common/scene/table_reader.h"
#include "common/world/container.h"
#include "common/world/world_description.h"

namespace talus {

template <int Dim>
inline constexpr auto obstacle_fields = std::to_array<Field<Pose<Dim>>>({
    {{},
     {.name = "kind",
      .required = true,
      .type = "text",
      .further_rule = "a kind of shape, or `\"container\"`",
      .meaning = "decides which keys of a shape or of a container belong here"}},
    {place_of<&Pose<Dim>::position>,
     {.name = "position",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "origin",
      .meaning =
          "where the origin of the shape's own axes goes: the middle of a box, ball or capsule, the outer corner "
          "of an L, `[0, 0]` of a hull's corners (so a hull may be given in the world's coordinates), the middle "
          "of a container's floor, or the origin of its `corners`"}},
    {{}, angle_key},
    {{}, axis_key},
    {{},
     {.name = "name",
      .type = "text",
      .further_rule = "of no other obstacle",
      .default_text = "none",
      .meaning = "for [events](#events-event) and [loads](#forces-on-ground-and-obstacles-load)"}},
    {{},
     {.name = "motion",
      .type = "table",
      .default_text = "none",
      .meaning = "how it moves by plan: `[obstacle.motion]`"}},
});

inline constexpr Key wall_key = {.name = "wall",
                                 .unit = "m",
                                 .range = length_range,
                                 .meaning = "thickness. Thin: fast bodies go through it within one step"};
inline constexpr Key floor_key = {.name = "floor",
                                  .meaning = "a slab beneath as thick as the walls; without, the ground is the floor"};

template <int Dim>
inline constexpr auto container_fields = std::to_array<Field<ContainerParams<Dim>>>({
    {place_of<&ContainerParams<Dim>::inner_size>,
     {.name = "inner_size",
      .required = true,
      .type = "lengths",
      .unit = "m",
      .range = length_range,
      .meaning = "inside, the last number the height of the walls"}},
    {place_of<&ContainerParams<Dim>::wall>, wall_key},
    {place_of<&ContainerParams<Dim>::floor>, floor_key},
});

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
    {place_of<&ConvexContainerParams::height>,
     {.name = "height", .required = true, .unit = "m", .range = length_range, .meaning = "of the walls"}},
    {place_of<&ConvexContainerParams::wall>, wall_key},
    {place_of<&ConvexContainerParams::floor>, floor_key},
});

/// Keys of `[pile.boundary]`.
struct BoundaryParams {
  double rim = 1.0;
  std::optional<double> wall = {};  // not given: no walls are built
  std::optional<bool> floor = {};
};

inline constexpr Key boundary_size_key = {.name = "size",
                                          .required = true,
                                          .type = "lengths",
                                          .unit = "m",
                                          .range = length_range,
                                          .meaning = "box: full width, `[x]` in 2D, `[x, y]` in 3D"};

inline constexpr auto boundary_fields = std::to_array<Field<BoundaryParams>>({
    {{},
     {.name = "kind",
      .required = true,
      .type = "text",
      .further_rule = R"(`"box"`, in 3D also `"cylinder"`, `"convex"`)",
      .meaning = "box: `size`; cylinder: `radius`; convex: `corners`, seen from `at`, which lies inside"}},
    {place_of<&BoundaryParams::rim>,
     {.name = "rim",
      .required = true,
      .unit = "m",
      .range = length_range,
      .meaning = "height of the walls above `at`"}},
    {{}, boundary_size_key},
    {{}, outline_radius_key},
    {{}, outline_corners_key},
    {place_of<&BoundaryParams::wall>,
     {.name = "wall",
      .unit = "m",
      .range = length_range,
      .default_text = "none are built",
      .meaning = "thickness. Thin: fast bodies go through it within one step"}},
    {place_of<&BoundaryParams::floor>,
     {.name = "floor",
      .default_text = "false",
      .meaning = "a slab beneath as thick as the walls; without, the ground is the floor. Not without `wall`"}},
});

/// One `[[obstacle]]`, appended to the scene's world; a container is as many as it has walls.
template <int Dim>
void read_obstacle(TableReader& table, Scene<Dim>& scene);

/// `[pile.boundary]`, the walls around a pile's middle. With `wall`, they are appended to the obstacles too.
template <int Dim>
Boundary<Dim> read_boundary(TableReader& table, const Vec<Dim>& at, std::vector<Obstacle<Dim>>& obstacles);

}  // namespace talus
