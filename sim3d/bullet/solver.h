#pragma once
// Bullet's solver with warm starting of friction.

#include <btBulletDynamicsCommon.h>

#include <vector>

namespace talus::bullet {

/// btSequentialImpulseConstraintSolver starts the normal impulse of each contact at 85 % of the last step's, but
/// friction at zero: ten iterations never find the friction that holds a pile, and it creeps without end. This solver
/// starts friction at the last step's, turned into the step's directions, as far as Coulomb's law and the normal
/// impulse started with allow. Ten iterations then creep like fifty without, at the cost of ten.
class WarmFrictionSolver : public btSequentialImpulseConstraintSolver {
 public:
  /// `warm_friction` false: Bullet's own solver.
  explicit WarmFrictionSolver(bool warm_friction) : warm_friction_(warm_friction) {}

 protected:
  bool warm_friction() const { return warm_friction_; }
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                btPersistentManifold** manifolds, int manifold_count, btTypedConstraint** joints,
                                int joint_count, const btContactSolverInfo& info, btIDebugDraw* drawer) override;
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                         const btContactSolverInfo& info) override;

 private:
  void start(btSolverConstraint& friction, const btSolverConstraint& contact, const btVector3& impulse);

  bool warm_friction_;
  std::vector<btVector3> last_;           // friction impulse of the last step, by contact [N s]
  std::vector<btManifoldPoint*> points_;  // scratch
};

}  // namespace talus::bullet
