#pragma once
// All that an engine must know before the first body exists.

#include <numbers>
#include <vector>

#include "common/shape/shape.h"
#include "common/world/body.h"
#include "common/world/skips.h"

namespace talus {

/// Settings of the engine's solver. An engine ignores what it does not have, and says so here.
struct SolverParams {
  int velocity_iterations = 10;        // 1..1000; too few: piles melt and tall stacks sink. Cost grows in proportion
  int position_iterations = 4;         // 1..1000, Box2D only; too few: bodies stay inside each other
  int friction_directions = 2;         // 1 or 2, Bullet in 3D only; 1: piles creep for ever and end 20 % too low
  bool warm_friction = false;          // Bullet only: friction starts at the last step's; heaps creep less, towers sway
  double restitution_threshold = 0.5;  // [m/s] >= 0; slower approaches do not bounce. Too low: piles never rest
};

/// The plane z = height, infinite for all practical purposes.
struct Ground {
  bool present = true;
  double height = 0.0;  // [m]
  Material material;    // its density means nothing
};

/// A shape that never moves.
template <int Dim>
struct Obstacle {
  Shape<Dim> shape;
  Pose<Dim> pose;
};

template <int Dim>
struct WorldDescription {
  double gravity = 9.81;   // [m/s^2] downwards, finite, >= 0
  double dt = 1.0 / 60.0;  // [s] in (0, 1/30]; above, bodies sink into each other by a third of a metre
  SolverParams solver;
  Skips skips;
  bool engine_sleep = false;  // the engine's own sleeping, whole islands at a time
  Ground ground;
  std::vector<Obstacle<Dim>> obstacles;
  std::vector<Shape<Dim>> shapes;  // BodyDef::shape indexes these
};

/// Throws std::invalid_argument with field, value and rule; backends call it first, since Bullet would swallow a bad
/// value and Box2D abort the process.
template <int Dim>
void check(const WorldDescription<Dim>& description);
template <int Dim>
void check(const BodyDef<Dim>& body, const WorldDescription<Dim>& description);

/// Farthest from the origin that a coordinate of a place may be [m]. Beyond, single precision resolves a millimetre at
/// best and contacts jitter.
inline constexpr double farthest_place = 1e4;

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
