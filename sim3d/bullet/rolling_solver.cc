#include "sim3d/bullet/rolling_solver.h"

#include <algorithm>
#include <optional>

#include "common/world/world_description.h"

namespace talus::bullet {
namespace {

constexpr btScalar share_at_start = 0.85F;  // of the last step's impulse, as Bullet starts its contacts

/// The arm of an object; none of what is no body.
std::optional<double> arm_of(const btCollisionObject& object) {
  if (object.getUserIndex() < 0) return std::nullopt;
  return static_cast<double>(object.getSpinningFriction());
}

std::uint64_t key_of(const btCollisionObject& a, const btCollisionObject& b) {
  return (std::uint64_t{static_cast<std::uint32_t>(a.getUserIndex())} << 32) |
         static_cast<std::uint32_t>(b.getUserIndex());
}

/// What an impulse about each axis changes of the body's spin.
btVector3 effect(const btSolverBody& body, const btVector3& impulse) {
  if (body.m_originalBody == nullptr) return {0, 0, 0};
  return body.m_originalBody->getInvInertiaTensorWorld() * impulse * body.m_angularFactor;
}

btVector3 spin_of(const btSolverBody& body) {
  if (body.m_originalBody == nullptr) return body.m_angularVelocity;
  return body.m_angularVelocity + body.m_externalTorqueImpulse + body.m_deltaAngularVelocity;
}

}  // namespace

void RollingSolver::start_step() {
  last_.swap(now_);
  now_.clear();
}

void RollingSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  WarmFrictionSolver::convertContacts(manifolds, count, info);
  rows_.clear();
  row_of_.clear();
  int contact = 0;  // Bullet makes the contacts' rows in this order
  for (int m = 0; m < count; ++m) {
    for (int i = 0; i < manifolds[m]->getNumContacts(); ++i) {
      const btManifoldPoint& point = manifolds[m]->getContactPoint(i);
      if (point.getDistance() <= manifolds[m]->getContactProcessingThreshold()) add(*manifolds[m], contact++);
    }
  }
  for (const Row& row : rows_) apply(row, row.impulse);
}

void RollingSolver::add(const btPersistentManifold& manifold, int contact) {
  const auto arm = static_cast<btScalar>(arm_of_pair(arm_of(*manifold.getBody0()), arm_of(*manifold.getBody1())));
  if (arm == 0) return;
  const std::uint64_t pair = key_of(*manifold.getBody0(), *manifold.getBody1());
  const auto [place, is_new] = row_of_.try_emplace(pair, rows_.size());
  if (is_new) {
    const btSolverConstraint& normal = m_tmpSolverContactConstraintPool[contact];
    Row& row = rows_.emplace_back();
    row.pair = pair;
    row.a = normal.m_solverBodyIdA;
    row.b = normal.m_solverBodyIdB;
    row.arm = arm;
    if (const auto last = last_.find(pair); last != last_.end()) row.impulse = share_at_start * last->second;
  }
  rows_[place->second].contacts.push_back(contact);
}

void RollingSolver::apply(const Row& row, const btVector3& impulse) {
  btSolverBody& a = m_tmpSolverBodyPool[row.a];
  btSolverBody& b = m_tmpSolverBodyPool[row.b];
  if (a.m_originalBody != nullptr) a.m_deltaAngularVelocity += effect(a, impulse);
  if (b.m_originalBody != nullptr) b.m_deltaAngularVelocity -= effect(b, impulse);
}

btScalar RollingSolver::solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** joints, int joint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) {
  const btScalar residual = WarmFrictionSolver::solveSingleIteration(iteration, bodies, body_count, manifolds,
                                                                     manifold_count, joints, joint_count, info, drawer);
  for (Row& row : rows_) solve(row);
  return residual;
}

/// The impulse that stops the relative spin along its own direction, no larger in all than the limit.
void RollingSolver::solve(Row& row) {
  const btSolverBody& a = m_tmpSolverBodyPool[row.a];
  const btSolverBody& b = m_tmpSolverBodyPool[row.b];
  btScalar push = 0;
  for (const int contact : row.contacts) push += m_tmpSolverContactConstraintPool[contact].m_appliedImpulse;
  const btVector3 spin = spin_of(a) - spin_of(b);
  const btScalar response = spin.dot(effect(a, spin) + effect(b, spin));
  btVector3 wanted = row.impulse;
  if (response > 0) wanted -= spin * (spin.length2() / response);
  const btScalar limit = row.arm * std::max(push, btScalar(0));
  const btScalar length = wanted.length();
  if (length > limit) wanted *= limit / length;
  apply(row, wanted - row.impulse);
  row.impulse = wanted;
}

btScalar RollingSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                                      const btContactSolverInfo& info) {
  for (const Row& row : rows_) now_[row.pair] = row.impulse;
  return WarmFrictionSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
}

}  // namespace talus::bullet
