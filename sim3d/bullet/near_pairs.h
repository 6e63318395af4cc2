#pragma once
// The walk over all pairs of bodies whose boxes overlap.

#include <btBulletCollisionCommon.h>

#include "common/world/team.h"
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

  /// `bodies`: those that are awake. Threads share what neither makes nor drops contacts' memory; the rest follows in
  /// the order of the pairs, so that the bits are the same for any number of threads.
  void collide(const btDispatcherInfo& info, std::span<btRigidBody* const> bodies, Team& team);

 private:
  void collide_steady(const btDispatcherInfo& info, std::span<btRigidBody* const> bodies, Team& team);
  bool visit_steady(btBroadphasePair& pair, const btDispatcherInfo& info);
  const PlacedBody* known_place(const btCollisionObject& body);
  void fetch_ahead(int i, int last) const;
  bool is_idle(const btBroadphasePair& pair);
  void visit(btBroadphasePair& pair, const btDispatcherInfo& info);
  void meet(btBroadphasePair& pair, const btCollisionObject& first, const btCollisionObject& second,
            const btDispatcherInfo& info);

  btCollisionDispatcher& dispatcher_;
  PairCache& pairs_;
  bool skip_idle_;
  std::vector<unsigned char> done_;  // by pair: whether collide_steady() did it in this step
};

}  // namespace talus::bullet
