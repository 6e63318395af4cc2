#pragma once
// Bullet's cache of overlapping pairs, with each body's partners at hand.

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <cstdint>
#include <span>
#include <vector>

#include "sim3d/bullet/placed_pieces.h"

namespace talus::bullet {

/// Replaces btHashedOverlappingPairCache, which finds the pairs of one body only by walking all pairs of the world;
/// this one keeps a list of partners per body, so that freezing, thawing and removing cost a body's own neighbours. The
/// number of a body's list is also its slot among the placed pieces. The order of pairs, on which results depend, is
/// Bullet's.
class PairCache final : public btHashedOverlappingPairCache {
 public:
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;

  /// Called by the broadphase for a proxy that is about to go. Takes no memory: it is part of the end of a world that
  /// ran out of it.
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  /// The same for an obstacle, which has no list. Costs O(pairs).
  void remove_pairs_of_obstacle(const btBroadphaseProxy* proxy, btDispatcher* dispatcher);
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

  /// Partners of a body that are static, in order of appearance; valid until the next call.
  std::span<btBroadphaseProxy* const> static_partners(const btBroadphaseProxy* proxy);

  /// The other sides of a body's pairs, in order of appearance.
  std::span<btBroadphaseProxy* const> partners(const btBroadphaseProxy* proxy) const;

  /// Number of the list of a body that has pairs; -1: it has none, or is ground or an obstacle.
  std::int32_t list_of(const btCollisionObject& object) const;

  /// The pieces of the bodies that have pairs.
  PlacedPieces& places() { return places_; }

  /// To be called when the body's form changes between awake and asleep.
  void forget_place(const btBroadphaseProxy* proxy);

 private:
  std::int32_t list_of(const btBroadphaseProxy* proxy) const;
  void remember(const btBroadphaseProxy* proxy, btBroadphaseProxy* partner);
  void forget(const btBroadphaseProxy* proxy, const btBroadphaseProxy* partner);

  // Ground and obstacles, which meet all bodies and seldom leave, have no list; nor have sleepers far from all awake
  // bodies.
  std::vector<std::vector<btBroadphaseProxy*>> lists_;
  std::vector<std::int32_t> free_;  // lists of no body
  std::vector<std::int32_t> lists_of_bodies_;
  std::vector<btBroadphaseProxy*> leaving_;  // scratch
  PlacedPieces places_;
};

}  // namespace talus::bullet
