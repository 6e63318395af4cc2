#pragma once
// Groups of touching bodies, for the solver.

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>

#include <vector>

namespace talus::bullet {

/// Replaces btDiscreteDynamicsWorld::solveConstraints, btSimulationIslandManager::buildAndProcessIslands and the
/// callback between the two, for a world without joints. The islands, the groups in which they reach the solver and the
/// order of their contacts are Bullet's. Different: the sort of the manifolds compares keys that lie beside the
/// pointers, where Bullet fetches two manifolds and four bodies a comparison; and a manifold without points is dropped
/// after the sort. (The sort is not stable, so the order of all others depends on it.) Gain:
/// lab/notes/bullet_step.md.
class Islands {
 public:
  /// Gives the solver all islands with an active body, as groups of more than `info.m_minimumSolverBatchSize`
  /// manifolds.
  void solve(btCollisionWorld& world, btUnionFind& sets, btConstraintSolver& solver, btContactSolverInfo& info);

 private:
  /// A manifold and the island that it belongs to.
  struct Member {
    int island;
    btPersistentManifold* manifold;
  };
  /// Bodies of one island: a range of the sorted sets.
  struct Range {
    int begin;
    int end;
  };
  void find_ranges(const btUnionFind& sets);
  void settle(const btUnionFind& sets, const btCollisionObjectArray& objects) const;
  void gather(btDispatcher& dispatcher);
  int take(int island, int from, bool active);
  void flush(btCollisionWorld& world, btConstraintSolver& solver, const btContactSolverInfo& info);

  std::vector<Range> ranges_;
  btAlignedObjectArray<Member> members_;  // Bullet's own array, for its sort
  btCollisionObjectArray bodies_;         // of the group to come
  btManifoldArray manifolds_;             // of the group to come, those with points
  int batch_ = 0;                         // manifolds of the group to come, with and without points
};

}  // namespace talus::bullet
