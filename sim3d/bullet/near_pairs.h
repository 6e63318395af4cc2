#pragma once
// The walk over all pairs of bodies whose boxes overlap.

#include <btBulletCollisionCommon.h>

#include "sim3d/bullet/compound_pair.h"
#include "sim3d/bullet/pairs.h"

namespace talus::bullet {

/// Replaces btCollisionDispatcher::dispatchAllCollisionPairs and defaultNearCallback. Two compound shapes meet without
/// the calls in between and with their pieces placed (placed_pieces.h); idle pairs are passed over (idle_pairs.h); the
/// memory of the pairs to come is fetched ahead. All other pairs take Bullet's way.
class NearPairs {
 public:
  NearPairs(btCollisionDispatcher& dispatcher, PairCache& pairs, bool skip_idle)
      : dispatcher_(dispatcher), pairs_(pairs), skip_idle_(skip_idle) {}

  void collide(const btDispatcherInfo& info);

 private:
  void fetch_ahead(int i) const;
  bool is_idle(const btBroadphasePair& pair);
  void visit(btBroadphasePair& pair, const btDispatcherInfo& info);
  void meet(btBroadphasePair& pair, const btCollisionObject& first, const btCollisionObject& second,
            const btDispatcherInfo& info);

  btCollisionDispatcher& dispatcher_;
  PairCache& pairs_;
  bool skip_idle_;
};

}  // namespace talus::bullet
