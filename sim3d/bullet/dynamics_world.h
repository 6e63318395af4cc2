#pragma once
// Bullet's world with its lists of bodies in our hands.

#include <btBulletDynamicsCommon.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/world/debug_options.h"
#include "common/world/team.h"
#include "sim3d/bullet/near_pairs.h"

namespace talus::bullet {

/// What solves the contacts of a step in the place of Bullet's islands and solver.
struct ContactStep {
  std::function<void()> drift;  // moves the bodies to where their contacts are to be detected
  std::function<void()> solve;  // undoes drift; gives the bodies the velocity with which Bullet moves them in this step
  std::function<void()> finish;  // gives them that at its end, once they have moved
};

/// btDiscreteDynamicsWorld visits all bodies of its two lists in each step. A sleeping body is in neither: its entry in
/// the broad phase alone makes it solid.
class DynamicsWorld final : public btDiscreteDynamicsWorld {
 public:
  /// `pairs`: what the broadphase keeps its pairs in.
  DynamicsWorld(btCollisionDispatcher& dispatcher, btBroadphaseInterface& broadphase, PairCache& pairs,
                btConstraintSolver& solver, btCollisionConfiguration& configuration, const DebugOptions& debug);

  /// Puts just these bodies into the lists, after the static objects; their broadphase entries exist already.
  void set_bodies(std::span<btRigidBody* const> bodies);

  /// Puts a static object into the list of objects until the next set_bodies().
  void list(btCollisionObject& object) { m_collisionObjects.push_back(&object); }

  /// Gives the static object a broadphase entry and a place in the lists, before any body.
  void add_static(btCollisionObject& object);
  /// Of which the entry in the broad phase was taken away.
  void restore_static(btCollisionObject& object);

  int listed_objects() const { return m_collisionObjects.size(); }

  void share_among(const std::shared_ptr<Team>& team) { team_ = team; }

  /// What the last collision detection took [s].
  double collide_seconds() const { return collide_seconds_; }

  /// What is to happen between collision detection and solver.
  void set_after_collision(std::function<void()> action) { after_collision_ = std::move(action); }

  /// Not for a world in which Bullet's own sleeping, of whole islands, is in use.
  void set_contact_step(ContactStep step) { contact_step_ = std::move(step); }

  /// Between two steps, where the bodies are.
  void detect_contacts();
  void performDiscreteCollisionDetection() override;
  void calculateSimulationIslands() override;
  void solveConstraints(btContactSolverInfo& info) override;
  void integrateTransforms(btScalar time_step) override;
  /// Leaves the velocities of moving obstacles as they were given. Bullet takes them from the difference of two poses
  /// in single precision, in which a turn below 0.0007 rad a step is none.
  void saveKinematicState(btScalar /*time_step*/) override {}

 private:
  std::span<btRigidBody* const> bodies() const;
  void find_pairs();
  void find_contacts();

  DebugOptions debug_;
  NearPairs near_pairs_;
  std::shared_ptr<Team> team_ = std::make_shared<Team>(1);
  int statics_ = 0;
  double collide_seconds_ = 0.0;
  std::function<void()> after_collision_ = [] {};
  std::optional<ContactStep> contact_step_;
};

}  // namespace talus::bullet
