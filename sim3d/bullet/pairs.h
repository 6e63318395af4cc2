#pragma once
// Bullet's cache of overlapping pairs, with each body's partners at hand.

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <cstdint>
#include <span>
#include <vector>

namespace talus::bullet {

/// btHashedOverlappingPairCache finds the pairs of one body only by walking all pairs of the world; this one keeps a
/// list of partners per body, so that freezing, thawing and removing cost a body's own neighbours. The order of pairs,
/// on which results depend, is Bullet's.
class PairCache final : public btHashedOverlappingPairCache {
 public:
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;

  /// As Bullet's, with the memory that the next pairs will need on its way: in a large heap it comes from afar.
  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) override;
  using btHashedOverlappingPairCache::processAllOverlappingPairs;

  /// Called by the broadphase for a proxy that is about to go.
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

  /// Partners of a body that are static, in order of appearance; valid until the next call.
  std::span<btBroadphaseProxy* const> static_partners(const btBroadphaseProxy* proxy);

  /// The other sides of a body's pairs, in order of appearance.
  std::span<btBroadphaseProxy* const> partners(const btBroadphaseProxy* proxy) const;

 private:
  std::int32_t list_of(const btBroadphaseProxy* proxy) const;  // -1: none
  void remember(const btBroadphaseProxy* proxy, btBroadphaseProxy* partner);
  void forget(const btBroadphaseProxy* proxy, const btBroadphaseProxy* partner);

  // Ground and obstacles, which meet everybody and never leave, have no list; nor have sleepers far from anybody awake.
  std::vector<std::vector<btBroadphaseProxy*>> lists_;
  std::vector<std::int32_t> free_;  // lists that are nobody's
  std::vector<std::int32_t> lists_of_bodies_;
  std::vector<btBroadphaseProxy*> leaving_;  // scratch
};

}  // namespace talus::bullet
