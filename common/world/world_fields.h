#pragma once
// The keys of the world, its solver and its ground.

#include <array>

#include "common/params/field.h"
#include "common/world/world_description.h"

namespace talus {

inline constexpr auto solver_fields = std::to_array<Field<SolverParams>>({
    {place_of<&SolverParams::kind>,
     {.name = "kind",
      .choices = solver_kinds,
      .default_text = "`small_steps`; with the policy `engine` \"engine\"",
      .meaning = "the solver of contacts: the engine's own solver, or the one of this project on the engine's "
                 "collision detection, in `sub_steps` short steps a step. Small steps bring a heap to rest and hold "
                 "towers. Not with the policy `engine`, whose sleep belongs to the engine's own solver"}},
    {place_of<&SolverParams::sub_steps>,
     {.name = "sub_steps",
      .range = between(1.0, 100.0),
      .default_text = "by `accuracy`",
      .meaning = "of `small_steps` only. 4: faster, towers of twenty fall; 2: bodies sink into each other"}},
    {place_of<&SolverParams::velocity_iterations>,
     {.name = "velocity_iterations",
      .range = between(1.0, 1000.0),
      .meaning = "of `engine` only. Too few: piles melt and tall stacks sink. Cost grows in proportion"}},
    {place_of<&SolverParams::position_iterations>,
     {.name = "position_iterations",
      .range = between(1.0, 1000.0),
      .meaning = "of `engine` on Box2D only. Too few: bodies stay inside each other"}},
    {place_of<&SolverParams::friction_directions>,
     {.name = "friction_directions",
      .range = between(1.0, 2.0),
      .meaning = "of `engine` on Bullet in 3D only. 1: piles creep without end and become 20 % too low"}},
    {place_of<&SolverParams::restitution_threshold>,
     {.name = "restitution_threshold",
      .unit = "m/s",
      .range = between(0.0, 1e3),
      .default_text = "0.5, for [small bodies](#small-and-large-bodies) less",
      .meaning = "slower approaches do not bounce. Too low: piles never come to rest"}},
});

inline constexpr auto ground_fields = std::to_array<Field<Ground>>({
    {place_of<&Ground::present>,
     {.name = "present", .meaning = "false: bodies that miss the obstacles fall without end"}},
    {place_of<&Ground::height>,
     {.name = "height", .unit = "m", .range = coordinate_range, .meaning = "height of the plane"}},
});

inline constexpr Key gravity_vector_key = {.name = "gravity", .unit = "m/s^2", .range = gravity_component_range};

template <int Dim>
inline constexpr auto world_fields = std::to_array<Field<WorldDescription<Dim>>>({
    {place_of<&WorldDescription<Dim>::gravity>,
     {.name = "gravity",
      .type = "number or vector",
      .unit = "m/s^2",
      .range = gravity_range,
      .meaning =
          "downwards, or a vector: `[1.7, -9.66]` is the same as everything tilted by 10 degrees. Piles, and in the "
          "policies `paper` and `adaptive` layers and columns, take the last axis as up all the same. Large: bodies "
          "sink into the "
          "ground, see [limits](#limits-of-the-engines)"}},
    {place_of<&WorldDescription<Dim>::dt>,
     {.name = "steps_per_second",
      .unit = "1/s",
      .stored = Stored::as_inverse,
      .range = between(1.0, 1e5),
      .further_rule =
          "from 30 on, on planar Bullet 40, on Bullet 50; for [small bodies](#small-and-large-bodies) more, "
          "for large ones fewer",
      .default_text = "by `accuracy`, 60 or more",
      .meaning = "the time step is its inverse. At 30 bodies sink into each other by up to 0.2 m; cost grows in "
                 "proportion"}},
    {place_of<&WorldDescription<Dim>::periodic_x>,
     {.name = "periodic_x",
      .type = "two numbers",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "the second above the first, by 4 extents of the largest body or more; only with the solver "
                      "`small_steps`",
      .default_text = "none",
      .meaning = "periodic sides: what leaves through one comes in through the other, and bodies touch through them. "
                 "Obstacles repeat too. A run takes up to half longer in 2D, a tenth in 3D"}},
    {place_of<&WorldDescription<Dim>::periodic_y>,
     {.name = "periodic_y",
      .dimension = 3,
      .elsewhere = "x is the only horizontal axis",
      .type = "two numbers",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "as `periodic_x`",
      .default_text = "none",
      .meaning = "the same along y"}},
    {{},
     {.name = "gravity_motion",
      .type = "table",
      .default_text = "none",
      .meaning = "how gravity changes by plan: `[world.gravity_motion]`"}},
    {{}, {.name = "solver", .type = "table", .default_text = "see below", .meaning = "`[world.solver]`"}},
});

}  // namespace talus
