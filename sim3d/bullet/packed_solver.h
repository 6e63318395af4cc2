#pragma once
// Bullet's solver on packed rows.

#include <vector>

#include "common/world/skips.h"
#include "sim3d/bullet/row_system.h"
#include "sim3d/bullet/solver.h"

namespace talus::bullet {

/// Replaces btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations: Bullet's constraints of a group are
/// packed (row_system.h), solved and put back. What the packed rows cannot hold (joints, rolling friction, softness)
/// takes Bullet's own way.
class PackedSolver final : public WarmFrictionSolver {
 public:
  PackedSolver(bool warm_friction, const Skips& skips) : WarmFrictionSolver(warm_friction), skips_(skips) {}

 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

 private:
  bool can_pack(const btContactSolverInfo& info) const;
  void pack_bodies();
  void pack_rows();
  void unpack();

  Skips skips_;
  RowSystem system_;
  std::vector<RowBodies> bodies_of_contacts_;
};

}  // namespace talus::bullet
