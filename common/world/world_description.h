#pragma once
// All that an engine needs before the first body exists.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/shape/shape.h"
#include "common/world/body.h"
#include "common/world/debug_options.h"
#include "common/world/periodic.h"
#include "common/world/unit_scale.h"

namespace talus {

inline constexpr std::string_view engine_solver = "engine";
inline constexpr std::string_view small_steps_solver = "small_steps";
inline constexpr std::array<std::string_view, 2> solver_kinds = {engine_solver, small_steps_solver};

inline constexpr int usual_sub_steps = 8;

/// Settings of the contact solver. An engine ignores what it does not have. solver_fields has the unit, range and
/// effect of each.
struct SolverParams {
  std::string kind = std::string(small_steps_solver);
  int sub_steps = usual_sub_steps;
  int velocity_iterations = 10;
  int position_iterations = 4;
  int friction_directions = 2;
  double restitution_threshold = 0.5;

  bool small_steps() const { return kind == small_steps_solver; }
};

/// Engine and solver of a run as lines of text have them: "box2d", or "box2d with its own solver".
std::string solved_by(std::string_view backend, std::string_view solver_kind);

/// The plane z = height, infinite for all practical purposes. ground_fields and surface_fields have the unit, range and
/// effect of each field.
struct Ground {
  bool present = true;
  double height = 0.0;
  Material material;  // its density means nothing
};

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

/// Whether a unit vector is so to 0.01 rad.
template <int Dim>
bool is_straight_down(const Vec<Dim>& down) {
  return (down - straight_down<Dim>()).norm() <= 0.01;
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
  std::vector<Shape<Dim>> shapes;    // BodyDef::shape indexes these
  std::optional<Vec<2>> periodic_x;  // the sides beyond which the world repeats itself [m]
  std::optional<Vec<2>> periodic_y;  // in 3D
  UnitScale units;                   // of the engine, see fitting_units()

  /// [m/s^2]
  Vec<Dim> gravity_vector() const { return gravity * down; }
  /// Without gravity the direction stays.
  void set_gravity(const Vec<Dim>& vector) {
    gravity = vector.norm();
    if (gravity > 0.0) down = vector / gravity;
  }
  Periodic<Dim> periodic() const {
    Periodic<Dim> sides;
    for (const auto& [axis, of_axis] : {std::pair(0, periodic_x), std::pair(1, periodic_y)}) {
      if (!of_axis || axis >= Dim - 1) continue;
      sides.low[axis] = of_axis->x();
      sides.period[axis] = of_axis->y() - of_axis->x();
    }
    return sides;
  }
};

/// Whether what rests in gravity `a` [m/s^2] rests in `b` too: they differ by at most a hundredth, a tilt of 0.6
/// degrees.
template <int Dim>
bool same_gravity(const Vec<Dim>& a, const Vec<Dim>& b) {
  return (a - b).norm() <= 0.01 * std::max(a.norm(), b.norm());
}

/// Friction of the contact of two surfaces: the geometric mean, as Box2D mixes them by itself.
inline double pair_friction(double a, double b) { return std::sqrt(a * b); }
/// Restitution of the contact of two surfaces, on all engines: the geometric mean.
inline double pair_restitution(double a, double b) { return std::sqrt(a * b); }

/// Torque by which the contact of two bodies resists turning, over the normal force [m]: the geometric mean of the
/// arms of both shapes. What is no body has none and leaves it to the other.
inline double arm_of_pair(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::sqrt(*a * *b) : a.value_or(b.value_or(0.0));
}

/// Throws InvalidValue. Backends call it first, since Bullet accepts a bad value without an error and Box2D aborts the
/// process.
template <int Dim>
void check(const WorldDescription<Dim>& description);
template <int Dim>
void check(const BodyDef<Dim>& body, const WorldDescription<Dim>& description);
/// Parts of that: the time step, in units of the engine; the periodic sides.
template <int Dim>
void check_step(const WorldDescription<Dim>& description, const UnitScale& units);
template <int Dim>
void check_sides(const WorldDescription<Dim>& description);
/// But for the widths of its parts, which depend on the bodies of the world.
template <int Dim>
void check(const Obstacle<Dim>& obstacle, const UnitScale& units, const std::string& field);

/// In the units of the engine: with fewer, bodies sink into each other.
inline constexpr double fewest_steps_per_second = 30.0;

/// Farthest from the origin that a coordinate of a place may be [m]. Beyond, single precision resolves a millimetre at
/// best and contacts jitter.
inline double farthest_place(const UnitScale& units = {}) { return 1e4 / units.lengths(); }

/// Least width of a piece in the units of an engine [m]. In 3D Bullet 3.24 lets cubes of 0.04 m sink through the ground
/// (margin 0.04 m). In 2D Box2D 2.4.1 keeps bodies 0.005 m apart (b2_linearSlop) and welds corners that lie closer.
inline constexpr double thinnest_piece_in_space = 0.05;
template <int Dim>
inline constexpr double thinnest_piece = Dim == 2 ? 0.005 : thinnest_piece_in_space;

/// Fastest that a body may be given [m/s] with steps of `dt` [s]. Box2D moves a body by at most 2 m a step
/// (b2_maxTranslation); Bullet's continuous collision was tried up to 500 m/s.
template <int Dim>
double fastest_speed(double dt, const UnitScale& units = {}) {
  return Dim == 2 ? 2.0 / units.lengths() / dt : 500.0 / units.speeds();
}

/// Fastest spin that a body may be given [rad/s]. Both engines cut it to a quarter turn a step (b2_maxRotation,
/// btRigidBody's MAX_ANGVEL).
inline double fastest_spin(double dt) { return std::numbers::pi / 2.0 / dt; }

/// `vector`, shortened where it is longer than `most`: by rounding too, so that World takes the fastest velocity.
template <typename Vector>
Vector limited(const Vector& vector, double most) {
  constexpr double rounding = 1e-12;
  const double length = vector.norm();
  if (!std::isfinite(length)) return vector.stableNormalized() * (most * (1.0 - rounding));  // its square overflows
  return length > most * (1.0 - rounding) ? Vector(vector * (most * (1.0 - rounding) / length)) : vector;
}

}  // namespace talus
