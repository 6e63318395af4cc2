#pragma once
// The contact solver of all engines: small steps with soft contacts.

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "common/math/vector.h"
#include "common/solver/solver_body.h"
#include "common/world/team.h"
#include "common/world/world_description.h"

namespace talus {

/// A point where two bodies touch or may touch within the step. All impulses act on b, their opposites on a.
///
/// What is carried from step to step is kept by the caller with the point: impulses of the last sub-step times the
/// number of sub-steps, so that they are of the size of a step's.
template <int Dim>
struct ContactPoint {
  int a = 0;  // slots of the bodies; 0 never moves
  int b = 0;
  VecF<Dim> normal = VecF<Dim>::Unit(Dim - 1);  // unit, from a to b
  VecF<Dim> arm_a = VecF<Dim>::Zero();          // from the centre of a to the point [m]
  VecF<Dim> arm_b = VecF<Dim>::Zero();
  float gap = 0.0F;  // at the start of the step; overlap is negative [m]
  float friction = 0.0F;
  float restitution = 0.0F;
  float cohesion = 0.0F;  // attraction of the pair where it touches, over the weight of the lighter body
  float rolling_arm =
      0.0F;  // largest torque against relative spin, over the normal force [m]; of the pair's first point

  /// Raises what holds its bodies together by the `grip` of the pair (World::set_grip()). `rolling_arm` without the
  /// grip is set before; `radius`: of the pair's bounding spheres, as arm_of_pair() has it [m].
  void hold(float grip, float radius) {
    constexpr float cohesion_of_grip = 8.0F;
    friction += grip;
    rolling_arm += grip * radius;
    cohesion = cohesion_of_grip * grip;
  }

  // Carried in and out.
  float normal_impulse = 0.0F;                      // below 0 where cohesion holds [N s]
  VecF<Dim> friction_impulse = VecF<Dim>::Zero();   // in the world's axes [N s]
  SpinF<Dim> rolling_impulse = SpinF<Dim>::Zero();  // of the pair's first point [N m s]

  /// Increase of the gap by these motions of the two bodies [m].
  float opening(const StepMotion<Dim>& motion_of_a, const StepMotion<Dim>& motion_of_b) const {
    return normal.dot(motion_of_b.of(arm_b) - motion_of_a.of(arm_a));
  }

  // In the step.
  float attraction = 0.0F;  // impulse of the cohesion [N s]
  /// With which the surfaces press on each other at the start: what is carried and what balances the attraction. A
  /// point that begins starts without, else the bodies would not attract each other until the solver has taken it back.
  float pressing_impulse() const { return normal_impulse == 0.0F ? 0.0F : std::max(0.0F, normal_impulse + attraction); }

  // After the step.
  float normal_sum = 0.0F;                     // impulse of the whole step [N s]
  VecF<Dim> friction_sum = VecF<Dim>::Zero();  // [N s]
  float approach_speed = 0.0F;                 // before the step [m/s]
};

/// Which version of the solver's inner loops: all give the same bits.
enum class SolverLanes { plain, sse2, avx2 };
/// The versions that this build and this processor have, the fastest last.
std::span<const SolverLanes> solver_lanes();

/// Solves the contacts of one step at a time: `sub_steps` short steps of one pass over the contacts each (Macklin et
/// al. 2019, "Small steps in physics simulation"), with contacts as stiff springs and a second pass without the springs
/// ("soft step" of Box2D v3). No detection between them: gaps follow from the bodies' motion. Measured in its own tests
/// and in docs/method.md.
///
/// Fill: start(), add bodies, then points; those of one pair side by side are solved together. Then solve(), then read
/// bodies and points. Memory is kept from step to step.
template <int Dim>
class ContactSolver {
 public:
  explicit ContactSolver(SolverLanes lanes = solver_lanes().back());
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;
  ~ContactSolver();

  /// Forgets bodies and points, but for body 0, which never moves.
  void start();
  /// Returns the body's slot.
  int add(const SolverBody<Dim>& body) {
    bodies_.push_back(body);
    return static_cast<int>(bodies_.size()) - 1;
  }
  void add(const ContactPoint<Dim>& point) {
    points_.push_back(point);
    points_.back().attraction = 0.0F;
    cohesive_ = cohesive_ || point.cohesion > 0.0F;
  }
  /// Returns a slot for the surface of an obstacle that moves along itself, at a point with this normal.
  int add_belt(const VecF<Dim>& velocity, const VecF<Dim>& normal) {
    SolverBody<Dim> belt;
    belt.velocity = along_plane<VecF<Dim>>(velocity, normal);
    return add(belt);
  }
  /// Accelerates a body throughout the step [m/s^2], beside gravity.
  void push(int slot, const VecF<Dim>& acceleration) { pushes_.push_back({slot, acceleration, SpinF<Dim>::Zero()}); }

  /// Advances velocities by `dt` [s] under `gravity` [m/s^2]. The caller moves the bodies by `way` and `turn`.
  void solve(const SolverParams& params, const VecF<Dim>& gravity, float dt);
  /// From now on, threads share steps of many bodies; the bits stay the same.
  void share_among(const std::shared_ptr<Team>& team) { team_ = team; }

  const SolverBody<Dim>& body(int slot) const { return bodies_[slot]; }
  /// Gap of a point at the end of the solved step [m].
  float gap_after(const ContactPoint<Dim>& point) const {
    return point.gap + point.opening(body(point.a).motion(), body(point.b).motion());
  }
  /// In the order in which they were added.
  std::span<const ContactPoint<Dim>> points() const { return points_; }

 private:
  struct Work;
  struct Push {
    int slot = 0;
    VecF<Dim> acceleration = VecF<Dim>::Zero();  // [m/s^2]
    SpinF<Dim> turning = SpinF<Dim>::Zero();     // [rad/s^2]
  };

  void attract(float gravity, float dt);
  void pull(int slot, const VecF<Dim>& arm, const VecF<Dim>& force);

  std::vector<SolverBody<Dim>> bodies_;
  std::vector<ContactPoint<Dim>> points_;
  std::vector<Push> pushes_;
  std::vector<int> cohesive_points_;  // scratch
  bool cohesive_ = false;             // some point
  std::unique_ptr<Work> work_;
  std::shared_ptr<Team> team_ = std::make_shared<Team>(1);
};

}  // namespace talus
