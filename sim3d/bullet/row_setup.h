#pragma once
// Constraint rows made from contact points.

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "sim3d/bullet/lanes.h"
#include "sim3d/bullet/row_system.h"

namespace talus::bullet {

/// Four vectors, one a lane.
struct Vectors {
  Lanes x;
  Lanes y;
  Lanes z;
};

inline Vectors same(const btVector3& v) { return {splat(v.x()), splat(v.y()), splat(v.z())}; }

/// The fourth is 0.
inline Vectors three(const btVector3& a, const btVector3& b, const btVector3& c) {
  return {lanes(a.x(), b.x(), c.x(), 0), lanes(a.y(), b.y(), c.y(), 0), lanes(a.z(), b.z(), c.z(), 0)};
}

inline Vectors operator-(const Vectors& a) { return {-a.x, -a.y, -a.z}; }

/// As btVector3::dot.
inline Lanes dot(const Vectors& a, const Vectors& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

/// As btVector3::cross.
inline Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// As btMatrix3x3 times btVector3, with the matrix by rows, then lane by lane times `factor`.
inline Vectors product(const btVector3 (&rows)[3], const Vectors& v, const btVector3& factor) {
  return {dot(same(rows[0]), v) * splat(factor.x()), dot(same(rows[1]), v) * splat(factor.y()),
          dot(same(rows[2]), v) * splat(factor.z())};
}

/// The first three vectors, each with a number of its own behind it.
struct ThreeRows {
  Lanes row[3];
};
inline ThreeRows by_rows(const Vectors& v, Lanes fourth) {
  Lanes a = v.x;
  Lanes b = v.y;
  Lanes c = v.z;
  Lanes d = fourth;
  transpose(a, b, c, d);
  return {{a, b, c}};
}

/// Replaces, for contacts with two friction directions, convertBodies, convertContact, setupContactConstraint,
/// setupFrictionConstraint, writeBackContacts and writeBackBodies of btSequentialImpulseConstraintSolver, and the warm
/// friction of WarmFrictionSolver. The three rows of a point (normal and friction) are computed side by side, one a
/// lane, each lane with Bullet's expressions, and written where the solver needs them; no btSolverBody and no
/// btSolverConstraint is made. Left out, since bodies of talus have none: torques from outside, anisotropic and rolling
/// friction, softness, friction anchors.
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
  std::int32_t index_of(btCollisionObject& object, RowSystem& system);
  void add_obstacle(btRigidBody& obstacle, RowSystem& system);
  void find_contacts(std::span<btPersistentManifold*> manifolds, RowSystem& system);
  void make_contact(std::size_t i, const btContactSolverInfo& info, RowSystem& system);
  void write_rows(std::size_t i, const ThreeRows& axes, const Sides& sides, Lanes gain, RowSystem& system) const;
  void start_friction(RowSystem& system) const;
  const Body& body(std::int32_t i) const { return bodies_[i]; }

  bool warm_friction_;
  std::vector<Body> bodies_;               // those of the group, the one that never moves, obstacles that move
  std::int32_t fixed_ = 0;                 // number of the one that never moves
  std::vector<RowBodies> sides_;           // by contact
  std::vector<btManifoldPoint*> points_;   // by contact
  std::vector<btVector3> last_frictions_;  // by contact: impulse of the last step [N s]
};

}  // namespace talus::bullet
