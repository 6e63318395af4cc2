#pragma once
// Bullet's contact points through the solver of all engines.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/solver/contact_solver.h"
#include "common/solver/drift.h"
#include "common/solver/fast_bodies.h"
#include "common/solver/pair_resistance.h"
#include "common/solver/ring.h"
#include "common/world/world_description.h"
#include "sim3d/contacts_ahead.h"
#include "sim3d/engine.h"
#include "sim3d/warm_start.h"

namespace talus::bullet {

/// In the place of Bullet's islands and solver (solver.kind = small_steps): the points of all manifolds go through
/// ContactSolver once a step. In the plane through that of two dimensions: points that lie behind each other, at the
/// front and the back of two bodies, are one there.
///
/// A point keeps the impulses of the last sub-step as Bullet's applied impulses, so that they stay with it from step to
/// step and over a sleep (WarmStart); impulse_of_step() and friction_of_step() are the sums.
template <int Dim>
class SmallSteps {
 public:
  /// `fastest_spin`: to which a body's is cut [rad/s]. `states`: of the world, `ring`: of its sleeping bodies, none
  /// where they feel nothing; both outlive this.
  SmallSteps(const WorldDescription<Dim>& description, double fastest_spin, const BodyStates<Dim>& states,
             std::optional<Ring<Dim>>& ring);

  void share_among(const std::shared_ptr<Team>& team) { solver_.share_among(team); }

  /// What acts on the bodies in a step besides their contacts.
  struct Actions {
    std::span<btRigidBody* const> moving;  // the obstacles that move in it
    std::span<const Vec<Dim>> belts;       // by number of the obstacle: velocity of the surface [m/s]; empty: no belt
    std::vector<std::pair<const btRigidBody*, Vec<Dim>>> pushes;  // accelerations of bodies [m/s^2]
    btVector3 gravity;                                            // [m/s^2]
  };
  /// Moves the awake bodies and the moving obstacles by half of the coming step, where their contacts are detected.
  void drift(std::span<btRigidBody* const> bodies, std::span<btRigidBody* const> moving);
  /// After drift() and the detection: puts them back and solves the contacts of the step. `bodies`: all that are not
  /// frozen. Leaves the bodies with the mean velocity of the step, by which Bullet is to move them.
  void solve(Engine& engine, std::span<btRigidBody* const> bodies, const Actions& actions);

  /// Appends the contacts of the last step that began within it, and sorts all by their bodies. `impulse_unit`: of the
  /// points' impulses [N s].
  void gather_ahead(double impulse_unit, std::vector<Contact<Dim>>& contacts) const;

  /// After they have moved: gives them the velocity at the end of the step.
  void finish(std::span<btRigidBody* const> bodies) const;

  /// With a ring, before their contacts go: awake bodies, in ascending order, fall asleep.
  void freeze(Engine& engine, std::span<btRigidBody* const> bodies);
  /// With a ring: the pose at which a body wakes. `waking`: all that wake with it, ascending. `renewed`: its contact
  /// points with sleeping neighbours, ground and obstacles, sorted by owner; their distances are between the places
  /// that Bullet has, where a neighbour that sleeps on has not moved.
  btTransform thaw(const btCollisionObject& object, std::span<const BodyIndex> waking, btVector3& velocity,
                   btVector3& spin, std::vector<WarmStart::Renewed>& renewed);

 private:
  /// A contact point that may begin within the step.
  struct Ahead {
    const btCollisionObject* a = nullptr;
    const btCollisionObject* b = nullptr;
    ContactPoint<Dim> point;
  };

  void expect_motion(Engine& engine, std::span<btRigidBody* const> bodies);
  bool passes_unseen(Engine& engine, std::span<btRigidBody* const> bodies);
  Mover mover_of(const btCollisionObject& object) const;
  void find_ahead(Engine& engine, btRigidBody& fast, bool first);
  void find_near(Engine& engine, const Mover& mover, bool first);
  void find_around(Engine& engine, const Mover& mover, float margin);
  bool is_fast(const btCollisionObject& object) const;
  bool is_found(const btCollisionObject& a, const btCollisionObject& b) const;
  void add_ahead(Engine& engine, const btCollisionObject& a, const btCollisionObject& b, const ContactPoint<3>& found);
  void add_new(Engine& engine, const btCollisionObject& a, const btCollisionObject& b, ContactPoint<Dim> point);
  void add_points_ahead(std::span<const Vec<Dim>> belts);
  int slot_at(const btCollisionObject& object, const VecF<Dim>& normal, std::span<const Vec<Dim>> belts);
  void add_bodies(std::span<btRigidBody* const> bodies, const Actions& actions);
  void add_points(btDispatcher& dispatcher, std::span<const Vec<Dim>> belts);
  void add_points(btPersistentManifold& manifold, std::span<const Vec<Dim>> belts);
  void hand_over(const btPersistentManifold& manifold);
  void collect(btPersistentManifold& manifold, std::uint32_t last_step);
  int collect(const ContactPoint<Dim>& contact, int first);
  void keep(btPersistentManifold& manifold, std::span<btRigidBody* const> falling_asleep);
  void keep_near(Engine& engine, const btRigidBody& body);
  std::optional<ContactPoint<Dim>> in_world(const btCollisionObject& a, const btCollisionObject& b,
                                            const ContactPoint<3>& found) const;
  StepMotion<Dim> drift_of(const btCollisionObject& object) const;
  int slot_of(const btCollisionObject& object);
  void set_mean_velocities(std::span<btRigidBody* const> bodies) const;
  void write_points();
  const SpinF<Dim>* rolling_of(const btManifoldPoint& point, std::uint32_t step) const;
  PointMark marked(const SpinF<Dim>& on_owner);

  /// A point of Bullet's and the solver's that it is part of.
  struct Source {
    btManifoldPoint* point;
    int contact;
    int first;  // contact of its manifold
  };

  /// A manifold and its contacts in the solver.
  struct Solved {
    btPersistentManifold* manifold;
    int first;
    int contacts;
  };
  /// What the contacts of a manifold carry to the next step.
  struct Load {
    float normal = 0.0F;  // [N s times the mass scale]
    VecF<Dim> friction = VecF<Dim>::Zero();
  };

  const BodyStates<Dim>& states_;
  std::optional<Ring<Dim>>& ring_;
  SolverParams params_;
  float dt_;
  float fastest_spin_;      // [rad/s]
  float one_point_ = 0.0F;  // points of a planar pair that are nearer are one [m]
  ContactSolver<Dim> solver_;
  FastBodies<Dim> fast_;
  PairResistance<Dim> resistance_;
  Drift<Dim> drift_;
  std::vector<Ahead> ahead_;                    // the first points of the solver
  std::vector<const btCollisionObject*> near_;  // scratch
  std::vector<ContactPoint<3>> met_;            // scratch
  std::vector<ContactPoint<Dim>> met_ground_;   // scratch
  btManifoldArray known_;                       // scratch
  std::vector<ContactPoint<Dim>> contacts_;     // to come, of one manifold
  std::vector<Source> sources_;
  std::vector<Solved> manifolds_;
  std::vector<Load> loads_;  // of the last step: a manifold has the number of its own, and of the step
  std::vector<std::pair<btRigidBody*, btTransform>> starts_;  // poses of what has drifted
  std::vector<std::size_t> first_of_;         // by slot of an awake body, from 1 on: its number among the awake
  std::vector<int> parts_;                    // by contact: its points of Bullet's
  std::vector<btCollisionObject*> others_;    // sleepers and moving obstacles that have a slot
  std::vector<int> obstacle_slots_;           // by number; 0: does not move
  bool obstacles_stand_ = true;               // in this step
  std::vector<SleepingPoint<Dim>> released_;  // scratch
  /// Of the last step by the first contact of a manifold, and of points that come back [N m s times the mass scale].
  std::vector<SpinF<Dim>> rolling_;
  std::uint32_t step_ = 1;  // number of the last one, from 2 on: the mark of a new point is 0
};

}  // namespace talus::bullet
