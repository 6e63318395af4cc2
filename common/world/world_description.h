#pragma once
// All that an engine needs before the first body exists.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/params/field.h"
#include "common/shape/shape.h"
#include "common/world/body.h"
#include "common/world/debug_options.h"

namespace talus {

inline constexpr std::string_view engine_solver = "engine";
inline constexpr std::string_view small_steps_solver = "small_steps";
inline constexpr std::array<std::string_view, 2> solver_kinds = {engine_solver, small_steps_solver};

/// Settings of the contact solver. An engine ignores what it does not have. solver_fields has the unit, range and
/// effect of each.
struct SolverParams {
  std::string kind = std::string(engine_solver);
  int sub_steps = 8;
  int velocity_iterations = 10;
  int position_iterations = 4;
  int friction_directions = 2;
  bool warm_friction = false;
  double restitution_threshold = 0.5;

  bool small_steps() const { return kind == small_steps_solver; }
};

inline constexpr auto solver_fields = std::to_array<Field<SolverParams>>({
    {&SolverParams::kind,
     {.name = "kind",
      .choices = solver_kinds,
      .meaning = "the solver of contacts: the engine's own solver, or the one of this project on the engine's "
                 "collision detection, in `sub_steps` short steps a step. Small steps bring a heap to rest and hold "
                 "towers; `velocity_iterations`, `position_iterations`, `friction_directions` and "
                 "`warm_friction` mean nothing to it. Not with the policy `engine`"}},
    {&SolverParams::sub_steps,
     {.name = "sub_steps",
      .range = between(1.0, 100.0),
      .meaning = "of `small_steps` only. 4: faster, towers of twenty fall; 2: bodies sink into each other"}},
    {&SolverParams::velocity_iterations,
     {.name = "velocity_iterations",
      .range = between(1.0, 1000.0),
      .meaning = "too few: piles melt and tall stacks sink. Cost grows in proportion"}},
    {&SolverParams::position_iterations,
     {.name = "position_iterations",
      .range = between(1.0, 1000.0),
      .meaning = "Box2D only. Too few: bodies stay inside each other"}},
    {&SolverParams::friction_directions,
     {.name = "friction_directions",
      .range = between(1.0, 2.0),
      .meaning = "Bullet in 3D only. 1: piles creep without end and become 20 % too low"}},
    {&SolverParams::warm_friction,
     {.name = "warm_friction",
      .meaning = "Bullet only. true: friction starts each step at the last step's impulse. 10 iterations then hold a "
                 "small heap as 50 do, and one of 400 bodies nearly, for 13 to 38 % more time; the 3D scenes of this "
                 "project but `million_3d` have it. Towers one body wide sway more than without"}},
    {&SolverParams::restitution_threshold,
     {.name = "restitution_threshold",
      .unit = "m/s",
      .range = between(0.0, 1e3),
      .meaning = "slower approaches do not bounce. Too low: piles never come to rest"}},
});

/// The plane z = height, infinite for all practical purposes. ground_fields and surface_fields have the unit, range and
/// effect of each field.
struct Ground {
  bool present = true;
  double height = 0.0;
  Material material;  // its density means nothing
};

inline constexpr auto ground_fields = std::to_array<Field<Ground>>({
    {&Ground::present, {.name = "present", .meaning = "false: bodies that miss the obstacles fall without end"}},
    {&Ground::height, {.name = "height", .unit = "m", .range = coordinate_range, .meaning = "height of the plane"}},
});

/// A shape that no body moves.
template <int Dim>
struct Obstacle {
  Shape<Dim> shape;
  Pose<Dim> pose;
  bool moves = false;  // World::move_obstacle() may be called for it
};

/// The direction in which bodies fall by default.
template <int Dim>
Vec<Dim> straight_down() {
  Vec<Dim> down = Vec<Dim>::Zero();
  down[Dim - 1] = -1.0;
  return down;
}

/// All that an engine is made from. world_fields has the unit, range and effect of gravity and time step.
template <int Dim>
struct WorldDescription {
  double gravity = 9.81;
  Vec<Dim> down = straight_down<Dim>();  // direction of gravity, unit
  double dt = 1.0 / 60.0;                // [s]
  SolverParams solver;
  DebugOptions debug;
  bool engine_sleep = false;  // the engine's own sleeping, whole islands at a time
  Ground ground;
  std::vector<Obstacle<Dim>> obstacles;
  std::vector<Shape<Dim>> shapes;  // BodyDef::shape indexes these

  /// [m/s^2]
  Vec<Dim> gravity_vector() const { return gravity * down; }
};

/// Whether what rests in gravity `a` [m/s^2] rests in `b` too: they differ by at most a hundredth, a tilt of 0.6
/// degrees.
template <int Dim>
bool same_gravity(const Vec<Dim>& a, const Vec<Dim>& b) {
  return (a - b).norm() <= 0.01 * std::max(a.norm(), b.norm());
}

/// Friction of the contact of two surfaces: the geometric mean, as Box2D mixes them by itself.
inline double pair_friction(double a, double b) { return std::sqrt(a * b); }

/// Torque by which the contact of two bodies resists turning, over the normal force [m]: the geometric mean of the
/// arms of both shapes. What is no body has none and leaves it to the other.
inline double arm_of_pair(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::sqrt(*a * *b) : a.value_or(b.value_or(0.0));
}

inline constexpr Key gravity_vector_key = {.name = "gravity", .unit = "m/s^2", .range = gravity_component_range};

template <int Dim>
inline constexpr auto world_fields = std::to_array<Field<WorldDescription<Dim>>>({
    {&WorldDescription<Dim>::gravity,
     {.name = "gravity",
      .type = "number or vector",
      .unit = "m/s^2",
      .range = gravity_range,
      .meaning =
          "downwards, or a vector: `[1.7, -9.66]` is the same as everything tilted by 10 degrees. Piles, and in the "
          "policies `paper` and `adaptive` layers and columns, take the last axis as up all the same. Large: bodies "
          "sink into the "
          "ground, see [limits](#limits-of-the-engines)"}},
    {&WorldDescription<Dim>::dt,
     {.name = "steps_per_second",
      .unit = "1/s",
      .stored = Stored::as_inverse,
      .range = between(30.0, 1e5),
      .meaning =
          "the time step is its inverse. At 30 bodies sink into each other by up to 0.2 m, below by a third of a "
          "metre; cost grows in proportion"}},
    {{},
     {.name = "gravity_motion",
      .type = "table",
      .default_text = "none",
      .meaning = "how gravity changes by plan: `[world.gravity_motion]`"}},
    {{}, {.name = "solver", .type = "table", .default_text = "see below", .meaning = "`[world.solver]`"}},
});

/// Throws InvalidValue; backends call it first, since Bullet would swallow a bad
/// value and Box2D abort the process.
template <int Dim>
void check(const WorldDescription<Dim>& description);
template <int Dim>
void check(const BodyDef<Dim>& body, const WorldDescription<Dim>& description);

/// Farthest from the origin that a coordinate of a place may be [m]. Beyond, single precision resolves a millimetre at
/// best and contacts jitter.
inline constexpr double farthest_place = 1e4;

/// Least width of a piece in 3D [m]: Bullet 3.24 lets cubes of 0.04 m sink through the ground (margin 0.04 m).
inline constexpr double thinnest_piece_in_space = 0.05;

/// Fastest that a body may be given [m/s] with steps of `dt` [s]. Box2D moves a body by at most 2 m a step
/// (b2_maxTranslation); Bullet's continuous collision was tried up to 500 m/s.
template <int Dim>
double fastest_speed(double dt) {
  return Dim == 2 ? 2.0 / dt : 500.0;
}

/// Fastest spin that a body may be given [rad/s]. Both engines cut it to a quarter turn a step (b2_maxRotation,
/// btRigidBody's MAX_ANGVEL).
inline double fastest_spin(double dt) { return std::numbers::pi / 2.0 / dt; }

}  // namespace talus
