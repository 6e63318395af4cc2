#include "sim3d/bullet/solver.h"

#include <algorithm>

#include "sim3d/friction_impulse.h"

namespace talus::bullet {

void WarmFrictionSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  if (!warm_friction_) {
    btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
    return;
  }
  // Read before Bullet chooses this step's friction directions, in the order in which it makes the contacts' rows.
  last_.clear();
  for (int m = 0; m < count; ++m) {
    for (int i = 0; i < manifolds[m]->getNumContacts(); ++i) {
      const btManifoldPoint& point = manifolds[m]->getContactPoint(i);
      if (point.getDistance() <= manifolds[m]->getContactProcessingThreshold())
        last_.push_back(friction_impulse(point));
    }
  }
  btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
  const int rows = (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0 ? 2 : 1;
  for (int c = 0; c < m_tmpSolverContactConstraintPool.size(); ++c) {
    const btSolverConstraint& contact = m_tmpSolverContactConstraintPool[c];
    for (int row = 0; row < rows; ++row)
      start(m_tmpSolverContactFrictionConstraintPool[contact.m_frictionIndex + row], contact, last_[c]);
  }
}

void WarmFrictionSolver::start(btSolverConstraint& friction, const btSolverConstraint& contact,
                               const btVector3& impulse) {
  // The direction is that on the first body; where that one is static, that on the second body.
  const btVector3 direction =
      friction.m_contactNormal1.isZero() ? -friction.m_contactNormal2 : friction.m_contactNormal1;
  const btScalar limit = friction.m_friction * btScalar(contact.m_appliedImpulse);
  const btScalar along = std::clamp(impulse.dot(direction), -limit, limit);
  friction.m_appliedImpulse = along;
  btSolverBody& a = m_tmpSolverBodyPool[friction.m_solverBodyIdA];
  btSolverBody& b = m_tmpSolverBodyPool[friction.m_solverBodyIdB];
  a.internalApplyImpulse(friction.m_contactNormal1 * a.internalGetInvMass(), friction.m_angularComponentA, along);
  b.internalApplyImpulse(friction.m_contactNormal2 * b.internalGetInvMass(), friction.m_angularComponentB, along);
}

btScalar WarmFrictionSolver::solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                                  btPersistentManifold** manifolds, int manifold_count,
                                                  btTypedConstraint** joints, int joint_count,
                                                  const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const btScalar residual = btSequentialImpulseConstraintSolver::solveSingleIteration(
      iteration, bodies, body_count, manifolds, manifold_count, joints, joint_count, info, drawer);
  // Bullet leaves out the friction of a contact that no longer pushes; what it started with must go.
  for (int i = 0; warm_friction_ && i < m_tmpSolverContactFrictionConstraintPool.size(); ++i) {
    btSolverConstraint& friction = m_tmpSolverContactFrictionConstraintPool[i];
    const btScalar push = m_tmpSolverContactConstraintPool[friction.m_frictionIndex].m_appliedImpulse;
    if (push <= 0 && btScalar(friction.m_appliedImpulse) != 0) {
      friction.m_lowerLimit = 0;
      friction.m_upperLimit = 0;
      resolveSingleConstraintRowGeneric(m_tmpSolverBodyPool[friction.m_solverBodyIdA],
                                        m_tmpSolverBodyPool[friction.m_solverBodyIdB], friction);
    }
  }
  return residual;
}

// A point found again in the next step keeps its two friction impulses, but gets the directions of btPlaneSpace1: the
// impulses are left in those.
btScalar WarmFrictionSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                                           const btContactSolverInfo& info) {
  points_.clear();
  for (int c = 0; warm_friction_ && c < m_tmpSolverContactConstraintPool.size(); ++c)
    points_.push_back(static_cast<btManifoldPoint*>(m_tmpSolverContactConstraintPool[c].m_originalContactPoint));
  const btScalar residual = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
  for (btManifoldPoint* point : points_) set_friction_impulse(*point, friction_impulse(*point));
  return residual;
}

}  // namespace talus::bullet
