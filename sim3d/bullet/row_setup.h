#pragma once
// Constraint rows made from contact points.

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "sim3d/bullet/row_system.h"
#include "sim3d/bullet/three_rows.h"

namespace talus::bullet {

/// Replaces, for contacts with two friction directions, convertBodies, convertContact, setupContactConstraint,
/// setupFrictionConstraint, writeBackContacts and writeBackBodies of btSequentialImpulseConstraintSolver, and the warm
/// friction of WarmFrictionSolver. The three rows of a point (normal and friction) are computed side by side, one a
/// lane, each lane with Bullet's expressions, and written where the solver needs them; no btSolverBody and no
/// btSolverConstraint is made. Left out, since bodies of talus have none: torques from outside, anisotropic and rolling
/// friction, softness, friction anchors, kinematic bodies.
class RowSetup {
 public:
  explicit RowSetup(bool warm_friction) : warm_friction_(warm_friction) {}

  /// Fills `system`. All bodies are rigid and move.
  void make(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds,
            const btContactSolverInfo& info, bool by_level, RowSystem& system);

  /// Gives bodies and points what the solver has found.
  void write_back(const btContactSolverInfo& info, RowSystem& system) const;

 private:
  /// What rows need of a body; all zero for the one that stands for those that never move.
  struct Body {
    btRigidBody* rigid = nullptr;
    btVector3 origin = btVector3(0, 0, 0);
    btVector3 velocity = btVector3(0, 0, 0);        // with gravity [m/s]
    btVector3 spin = btVector3(0, 0, 0);            // [rad/s]
    btVector3 pushed_spin = btVector3(0, 0, 0);     // with the gyroscopic impulse [rad/s]
    btVector3 force_impulse = btVector3(0, 0, 0);   // as change of velocity [m/s]
    btVector3 torque_impulse = btVector3(0, 0, 0);  // as change of spin [rad/s]
    btVector3 angular_factor = btVector3(0, 0, 0);
    btVector3 inv_inertia[3] = {btVector3(0, 0, 0), btVector3(0, 0, 0), btVector3(0, 0, 0)};  // rows, world's axes
    btScalar inv_mass = 0;
  };
  struct Side;
  struct Sides;
  void add_body(btCollisionObject& object, btScalar time_step, RowSystem& system);
  void find_contacts(std::span<btPersistentManifold*> manifolds, RowSystem& system);
  void make_contact(std::size_t i, const btContactSolverInfo& info, RowSystem& system);
  void write_rows(std::size_t i, const ThreeRows& axes, const Sides& sides, Lanes gain, RowSystem& system) const;
  void start_friction(RowSystem& system) const;
  const Body& body(std::int32_t i) const { return bodies_[i]; }

  bool warm_friction_;
  std::vector<Body> bodies_;
  std::vector<RowBodies> sides_;           // by contact
  std::vector<btManifoldPoint*> points_;   // by contact
  std::vector<btVector3> last_frictions_;  // by contact: impulse of the last step [N s]
};

}  // namespace talus::bullet
