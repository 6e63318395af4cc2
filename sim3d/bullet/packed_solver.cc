#include "sim3d/bullet/packed_solver.h"

namespace talus::bullet {
namespace {

PackedRow packed(const btSolverConstraint& row) {
  // The normal is that on the first body; where that one never moves Bullet leaves it empty.
  const btVector3 normal = row.m_contactNormal1.isZero() ? -row.m_contactNormal2 : row.m_contactNormal1;
  return {lanes(normal, row.m_rhs),
          lanes(row.m_relpos1CrossNormal, row.m_jacDiagABInv),
          lanes(row.m_relpos2CrossNormal, row.m_friction),
          lanes(row.m_angularComponentA),
          lanes(row.m_angularComponentB),
          row.m_appliedImpulse,
          row.m_solverBodyIdA,
          row.m_solverBodyIdB,
          -1};
}

}  // namespace

btScalar PackedSolver::solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                  int manifold_count, btTypedConstraint** joints, int joint_count,
                                  const btContactSolverInfo& info, btIDebugDraw* drawer, btDispatcher* dispatcher) {
  if (!can_set_up(info, joint_count)) {
    return WarmFrictionSolver::solveGroup(bodies, body_count, manifolds, manifold_count, joints, joint_count, info,
                                          drawer, dispatcher);
  }
  setup_.make(std::span(bodies, body_count), std::span(manifolds, manifold_count), info, !debug_.bullet_row_order,
              system_);
  system_.solve(settings(info));
  setup_.write_back(info, system_);
  return 0;
}

bool PackedSolver::can_set_up(const btContactSolverInfo& info, int joints) const {
  constexpr int mode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD | SOLVER_USE_2_FRICTION_DIRECTIONS;
  return !debug_.bullet_row_setup && joints == 0 && info.m_solverMode == mode && info.m_splitImpulse != 0 &&
         info.m_globalCfm == 0;
}

RowSystem::Settings PackedSolver::settings(const btContactSolverInfo& info) const {
  return {info.m_numIterations, info.m_leastSquaresResidualThreshold, warm_friction()};
}

btScalar PackedSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                         btPersistentManifold** manifolds, int manifold_count,
                                                         btTypedConstraint** joints, int joint_count,
                                                         const btContactSolverInfo& info, btIDebugDraw* drawer) {
  if (!can_pack(info)) {
    return WarmFrictionSolver::solveGroupCacheFriendlyIterations(bodies, body_count, manifolds, manifold_count, joints,
                                                                 joint_count, info, drawer);
  }
  pack_bodies();
  pack_rows();
  system_.solve(settings(info));
  unpack();
  return 0;
}

bool PackedSolver::can_pack(const btContactSolverInfo& info) const {
  constexpr int other_orders = SOLVER_RANDMIZE_ORDER | SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS;
  return info.m_globalCfm == 0 && (info.m_solverMode & other_orders) == 0 &&
         m_tmpSolverNonContactConstraintPool.size() == 0 && m_tmpSolverContactRollingFrictionConstraintPool.size() == 0;
}

void PackedSolver::pack_bodies() {
  system_.clear(m_tmpSolverBodyPool.size(), m_fixedBodyId);
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    const btSolverBody& body = m_tmpSolverBodyPool[i];
    system_.body(i) = {lanes(body.m_deltaLinearVelocity), lanes(body.m_deltaAngularVelocity), lanes(body.m_invMass)};
  }
}

void PackedSolver::pack_rows() {
  const int contacts = m_tmpSolverContactConstraintPool.size();
  const int directions = contacts > 0 ? m_tmpSolverContactFrictionConstraintPool.size() / contacts : 1;
  bodies_of_contacts_.clear();
  for (int i = 0; i < contacts; ++i) {
    const btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
    bodies_of_contacts_.push_back({row.m_solverBodyIdA, row.m_solverBodyIdB});
  }
  system_.arrange(bodies_of_contacts_, directions, !debug_.bullet_row_order);
  for (int i = 0; i < contacts; ++i) {
    const btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
    system_.contact(i) = packed(row);
    if (row.m_rhsPenetration != 0) system_.add_deep(i, row.m_rhsPenetration);
  }
  for (int i = 0; i < m_tmpSolverContactFrictionConstraintPool.size(); ++i) {
    const btSolverConstraint& row = m_tmpSolverContactFrictionConstraintPool[i];
    PackedRow& made = system_.friction(i);
    made = packed(row);
    made.contact = system_.place_of_contact(row.m_frictionIndex);
  }
}

void PackedSolver::unpack() {
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i)
    m_tmpSolverContactConstraintPool[i].m_appliedImpulse = system_.contact(i).applied;
  for (int i = 0; i < m_tmpSolverContactFrictionConstraintPool.size(); ++i)
    m_tmpSolverContactFrictionConstraintPool[i].m_appliedImpulse = system_.friction(i).applied;
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    btSolverBody& body = m_tmpSolverBodyPool[i];
    body.m_deltaLinearVelocity = to_vector(system_.body(i).linear);
    body.m_deltaAngularVelocity = to_vector(system_.body(i).angular);
    if (const PackedBody* push = system_.push(i)) {
      body.m_pushVelocity = to_vector(push->linear);
      body.m_turnVelocity = to_vector(push->angular);
    }
  }
}

}  // namespace talus::bullet
