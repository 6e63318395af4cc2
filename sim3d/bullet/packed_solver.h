#pragma once
// Bullet's solver on packed rows.

#include <vector>

#include "common/world/debug_options.h"
#include "sim3d/bullet/row_setup.h"
#include "sim3d/bullet/row_system.h"
#include "sim3d/bullet/solver.h"

namespace talus::bullet {

/// Replaces btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations: Bullet's constraints of a group are
/// packed (row_system.h), solved and put back; with two friction directions solveGroup as a whole, the rows made
/// straight from the points (row_setup.h). What packed rows cannot hold (joints, rolling friction, softness) takes
/// Bullet's way.
class PackedSolver final : public WarmFrictionSolver {
 public:
  PackedSolver(bool warm_friction, const DebugOptions& debug)
      : WarmFrictionSolver(warm_friction), debug_(debug), setup_(warm_friction) {}

  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds, int manifold_count,
                      btTypedConstraint** joints, int joint_count, const btContactSolverInfo& info,
                      btIDebugDraw* drawer, btDispatcher* dispatcher) override;

 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

 private:
  RowSystem::Settings settings(const btContactSolverInfo& info) const;
  bool can_set_up(const btContactSolverInfo& info, int joints) const;
  bool can_pack(const btContactSolverInfo& info) const;
  void pack_bodies();
  void pack_rows();
  void unpack();

  DebugOptions debug_;
  RowSystem system_;
  RowSetup setup_;
  std::vector<RowBodies> bodies_of_contacts_;
};

}  // namespace talus::bullet
