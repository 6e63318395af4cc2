#include "sim3d/pairs.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>

namespace talus::bullet {
namespace {

int index_of(const btBroadphaseProxy* proxy) {
  return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
}

bool is_static(const btBroadphaseProxy* proxy) {
  return proxy->m_collisionFilterGroup == btBroadphaseProxy::StaticFilter;
}

}  // namespace

btBroadphasePair* PairCache::addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  const int before = getNumOverlappingPairs();
  btBroadphasePair* pair = btHashedOverlappingPairCache::addOverlappingPair(a, b);
  if (getNumOverlappingPairs() > before) {
    remember(a, b);
    remember(b, a);
  }
  return pair;
}

void* PairCache::removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) {
  forget(a, b);
  forget(b, a);
  return btHashedOverlappingPairCache::removeOverlappingPair(a, b, dispatcher);
}

void PairCache::remember(const btBroadphaseProxy* proxy, btBroadphaseProxy* partner) {
  const int index = index_of(proxy);
  if (index >= 0) {
    const auto slot = static_cast<std::size_t>(index);
    if (partners_.size() <= slot) {
      partners_.resize(slot + 1);
    }
    partners_[slot].push_back(partner);
  }
}

void PairCache::forget(const btBroadphaseProxy* proxy, const btBroadphaseProxy* partner) {
  const int index = index_of(proxy);
  if (index >= 0 && static_cast<std::size_t>(index) < partners_.size()) {
    std::vector<btBroadphaseProxy*>& list = partners_[static_cast<std::size_t>(index)];
    const auto found = std::find(list.begin(), list.end(), partner);
    if (found != list.end()) {
      list.erase(found);
      if (list.empty()) {
        list.shrink_to_fit();  // sleepers, the many, have none
      }
    }
  }
}

void PairCache::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  const std::span<btBroadphaseProxy* const> all = partners(proxy);
  leaving_.assign(all.begin(), all.end());
  for (btBroadphaseProxy* partner : leaving_) {
    removeOverlappingPair(proxy, partner, dispatcher);
  }
}

void PairCache::cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  for (btBroadphaseProxy* partner : partners(proxy)) {
    cleanOverlappingPair(*findPair(proxy, partner), dispatcher);
  }
}

std::span<btBroadphaseProxy* const> PairCache::static_partners(const btBroadphaseProxy* proxy) {
  const std::span<btBroadphaseProxy* const> all = partners(proxy);
  leaving_.assign(all.begin(), all.end());
  std::erase_if(leaving_, [](const btBroadphaseProxy* partner) { return !is_static(partner); });
  return leaving_;
}

std::span<btBroadphaseProxy* const> PairCache::partners(const btBroadphaseProxy* proxy) const {
  const int index = index_of(proxy);
  if (index < 0 || static_cast<std::size_t>(index) >= partners_.size()) {
    return {};
  }
  return partners_[static_cast<std::size_t>(index)];
}

}  // namespace talus::bullet
