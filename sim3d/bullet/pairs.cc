#include "sim3d/bullet/pairs.h"

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

std::int32_t PairCache::list_of(const btBroadphaseProxy* proxy) const {
  return list_of(*static_cast<const btCollisionObject*>(proxy->m_clientObject));
}

std::int32_t PairCache::list_of(const btCollisionObject& object) const {
  const int index = object.getUserIndex();
  const bool known = index >= 0 && index < std::ssize(lists_of_bodies_);
  return known ? lists_of_bodies_[index] : -1;
}

void PairCache::remember(const btBroadphaseProxy* proxy, btBroadphaseProxy* partner) {
  const int index = index_of(proxy);
  if (index < 0) return;
  if (list_of(proxy) < 0) {
    if (free_.empty()) {
      lists_.emplace_back();
      free_.reserve(lists_.capacity());  // for all of them, so that forget() takes no memory
      free_.push_back(static_cast<std::int32_t>(lists_.size()) - 1);
    }
    if (std::ssize(lists_of_bodies_) <= index) lists_of_bodies_.resize(index + 1, -1);
    places_.grow(free_.back());
    places_.forget(free_.back());
    lists_of_bodies_[index] = free_.back();
    free_.pop_back();
  }
  lists_[list_of(proxy)].push_back(partner);
}

void PairCache::forget(const btBroadphaseProxy* proxy, const btBroadphaseProxy* partner) {
  const std::int32_t number = list_of(proxy);
  if (number < 0) return;
  std::vector<btBroadphaseProxy*>& list = lists_[number];
  const auto found = std::find(list.begin(), list.end(), partner);
  if (found != list.end()) list.erase(found);
  if (list.empty()) {
    lists_of_bodies_[index_of(proxy)] = -1;
    free_.push_back(number);
  }
}

void PairCache::forget_place(const btBroadphaseProxy* proxy) {
  if (const std::int32_t slot = list_of(proxy); slot >= 0) places_.forget(slot);
}

void PairCache::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  while (!partners(proxy).empty())
    removeOverlappingPair(proxy, partners(proxy).front(), dispatcher);  // takes it off the list
}

void PairCache::remove_pairs_of_obstacle(const btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  const btBroadphasePairArray& pairs = getOverlappingPairArray();
  for (int i = 0; i < pairs.size();)
    if (pairs[i].m_pProxy0 == proxy || pairs[i].m_pProxy1 == proxy)
      removeOverlappingPair(pairs[i].m_pProxy0, pairs[i].m_pProxy1, dispatcher);  // puts the last pair in its place
    else
      ++i;
}

void PairCache::cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  for (btBroadphaseProxy* partner : partners(proxy)) cleanOverlappingPair(*findPair(proxy, partner), dispatcher);
}

std::span<btBroadphaseProxy* const> PairCache::static_partners(const btBroadphaseProxy* proxy) {
  const std::span<btBroadphaseProxy* const> all = partners(proxy);
  leaving_.assign(all.begin(), all.end());
  std::erase_if(leaving_, [](const btBroadphaseProxy* partner) { return !is_static(partner); });
  return leaving_;
}

std::span<btBroadphaseProxy* const> PairCache::partners(const btBroadphaseProxy* proxy) const {
  const std::int32_t number = list_of(proxy);
  if (number < 0) return {};
  return lists_[number];
}

}  // namespace talus::bullet
