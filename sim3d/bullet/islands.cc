#include "sim3d/bullet/islands.h"

namespace talus::bullet {
namespace {

bool sleeps(const btCollisionObject& object) { return object.getActivationState() == ISLAND_SLEEPING; }

bool keeps_awake(const btCollisionObject& object) {
  return object.getActivationState() == ACTIVE_TAG || object.getActivationState() == DISABLE_DEACTIVATION;
}

/// Fetches what a manifold has besides its points: its last bytes.
void fetch_head(const btPersistentManifold& manifold) {
  const char* end = reinterpret_cast<const char*>(&manifold + 1);
  __builtin_prefetch(end - 64);
  __builtin_prefetch(end - 1);
}

}  // namespace

void Islands::solve(btCollisionWorld& world, btUnionFind& sets, btConstraintSolver& solver, btContactSolverInfo& info) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  sets.sortIslands();
  find_ranges(sets);
  settle(sets, objects);
  gather(*world.getDispatcher());
  int next = 0;
  for (const Range& range : ranges_) {
    bool active = false;
    for (int i = range.begin; i < range.end; ++i) active = active || objects[sets.getElement(i).m_sz]->isActive();
    for (int i = range.begin; active && i < range.end; ++i) bodies_.push_back(objects[sets.getElement(i).m_sz]);
    next = take(sets.getElement(range.begin).m_id, next, active);
    if (batch_ > info.m_minimumSolverBatchSize) flush(world, solver, info);
  }
  flush(world, solver, info);
}

void Islands::find_ranges(const btUnionFind& sets) {
  ranges_.clear();
  const int count = sets.getNumElements();
  for (int begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && sets.getElement(end).m_id == sets.getElement(begin).m_id) ++end;
    ranges_.push_back({begin, end});
  }
}

// Bullet's own sleeping, of whole islands.
void Islands::settle(const btUnionFind& sets, const btCollisionObjectArray& objects) const {
  for (const Range& range : ranges_) {
    bool all_sleep = true;
    for (int i = range.begin; i < range.end && all_sleep; ++i)
      all_sleep = !keeps_awake(*objects[sets.getElement(i).m_sz]);
    for (int i = range.begin; i < range.end; ++i) {
      btCollisionObject& object = *objects[sets.getElement(i).m_sz];
      if (all_sleep) {
        object.setActivationState(ISLAND_SLEEPING);
      } else if (sleeps(object)) {
        object.setActivationState(WANTS_DEACTIVATION);
        object.setDeactivationTime(0);
      }
    }
  }
}

void Islands::gather(btDispatcher& dispatcher) {
  members_.resize(0);
  btPersistentManifold** manifolds = dispatcher.getInternalManifoldPointer();
  constexpr int ahead = 8;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    if (i + ahead < dispatcher.getNumManifolds()) fetch_head(*manifolds[i + ahead]);
    const btCollisionObject& first = *manifolds[i]->getBody0();
    const btCollisionObject& second = *manifolds[i]->getBody1();
    if ((!sleeps(first) || !sleeps(second)) && dispatcher.needsResponse(&first, &second))
      members_.push_back({first.getIslandTag() >= 0 ? first.getIslandTag() : second.getIslandTag(), manifolds[i]});
  }
  members_.quickSort([](const Member& a, const Member& b) { return a.island < b.island; });
}

/// Puts the island's manifolds into the group if it is active; where the next island's begin.
int Islands::take(int island, int from, bool active) {
  int next = from;
  for (; next < members_.size() && members_[next].island == island; ++next)
    if (active && members_[next].manifold->getNumContacts() > 0) manifolds_.push_back(members_[next].manifold);
  batch_ += active ? next - from : 0;
  return next;
}

void Islands::flush(btCollisionWorld& world, btConstraintSolver& solver, const btContactSolverInfo& info) {
  if (bodies_.size() > 0) {
    btPersistentManifold** manifolds = manifolds_.size() > 0 ? &manifolds_[0] : nullptr;
    solver.solveGroup(&bodies_[0], bodies_.size(), manifolds, manifolds_.size(), nullptr, 0, info, nullptr,
                      world.getDispatcher());
  }
  bodies_.resize(0);
  manifolds_.resize(0);
  batch_ = 0;
}

}  // namespace talus::bullet
