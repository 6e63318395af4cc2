#pragma once
// Bullet's solver with friction against rolling.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sim3d/bullet/solver.h"

namespace talus::bullet {

/// Resists the turning of bodies against what they touch, about any axis, with a torque of up to an arm times the
/// normal force (see arm_of_pair()): one row for each pair of bodies, solved after the contacts in each iteration and
/// started at the impulse of the last step. Bullet's own rolling friction limits the torque by a constant once the
/// normal impulse of a step exceeds 1 N s, and divides by zero where a body may not turn about all axes.
///
/// An object's arm is its `spinning friction`, which Bullet does not use without its rolling friction.
class RollingSolver final : public WarmFrictionSolver {
 public:
  /// Friction starts warm too: else a ball on a slope would creep.
  RollingSolver() : WarmFrictionSolver(true) {}

  /// Before the groups of a step are solved.
  void start_step();

 protected:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int body_count,
                                btPersistentManifold** manifolds, int manifold_count, btTypedConstraint** joints,
                                int joint_count, const btContactSolverInfo& info, btIDebugDraw* drawer) override;
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                         const btContactSolverInfo& info) override;

 private:
  struct Row {
    std::uint64_t pair = 0;
    int a = 0;  // in Bullet's pool of solver bodies
    int b = 0;
    btScalar arm = 0;                        // [m]
    btVector3 impulse = btVector3(0, 0, 0);  // on a [N m s times the mass scale]
    std::vector<int> contacts;               // in Bullet's pool of contact rows
  };
  void add(const btPersistentManifold& manifold, int contact);
  void solve(Row& row);
  void apply(const Row& row, const btVector3& impulse);

  std::vector<Row> rows_;                                  // of the group
  std::unordered_map<std::uint64_t, std::size_t> row_of_;  // by pair
  std::unordered_map<std::uint64_t, btVector3> last_;      // impulses of the last step by pair; looked up only
  std::unordered_map<std::uint64_t, btVector3> now_;
};

}  // namespace talus::bullet
