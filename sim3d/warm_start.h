#pragma once
// Contacts that outlive their pair.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "common/world/body.h"
#include "sim3d/bullet/pairs.h"
#include "sim3d/friction_impulse.h"

namespace talus::bullet {

/// Bullet gathers the points of a contact over several steps and starts the solver at their impulses of the step
/// before. Where a pair of bodies goes because both sleep, its pushing points are kept here, and put back in the first
/// step after one of the two has woken: a heap that is woken all at once carries itself from the first step on.
class WarmStart {
 public:
  /// New values of a kept point: those of the last solve in which its sleeping body took part.
  struct Renewed {
    BodyIndex owner = 0;
    BodyIndex partner = 0;
    btVector3 arm;          // from the owner's centre, in the world's axes [m]
    btScalar distance = 0;  // between the two surfaces [m]
    btScalar impulse = 0;   // [N s]
    btVector3 friction;     // impulse on the owner, in the world's axes [N s]
    PointMark mark;         // of its rolling impulse
  };

  /// Whether the first of two sides owns the points of their pair: of two bodies the one added first does; ground and
  /// obstacles own nothing.
  static bool owns(BodyIndex side, BodyIndex other) { return side >= 0 && (other < 0 || side < other); }

  /// Keeps the points of a pair that is about to go.
  void save(btBroadphasePair& pair);

  /// Replaces distances and impulses of the kept points of one owner. It must not have moved since they were kept.
  void renew(const btCollisionObject& owner, std::span<const Renewed> points);

  /// A body that has woken: the points of all its pairs are to be put back.
  void announce(btBroadphaseProxy& woken, const PairCache& pairs);

  /// Puts them back, after the collision detection of the step that follows.
  void restore(PairCache& pairs, const btDispatcherInfo& info);

  /// A body or an obstacle that leaves the world.
  void forget(BodyIndex side);

 private:
  struct SavedPoint {
    BodyIndex partner = 0;
    float place[3] = {};      // on the owner, in its axes [m]
    float normal[3] = {};     // from the partner to the owner, in the owner's axes
    float distance = 0;       // between the two surfaces [m], negative where they overlap
    float impulse = 0;        // along the normal [N s]
    float friction[3] = {};   // friction impulse on the owner, in the world's axes [N s]
    std::int16_t piece = -1;  // number within the owner's shape; -1 where the shape is a single piece
    std::int16_t partners_piece = -1;
    bool unconfirmed = false;  // no detection has found it since an earlier wake
    PointMark mark;
  };
  struct Node {
    SavedPoint point;
    std::int32_t next = -1;  // of the same owner, -1: the last
  };
  struct Sides;
  void keep(const Sides& sides, const SavedPoint& point);
  /// Takes out those between the two and appends them to `out`, in the order in which they were kept.
  void release(BodyIndex owner, BodyIndex partner, std::vector<SavedPoint>& out);
  void restore(btBroadphasePair& pair, const btDispatcherInfo& info);
  void open_manifolds(btCollisionAlgorithm& algorithm);
  /// `found`: points of the manifold that the collision detection has found, which are its first.
  static void put_back(const SavedPoint& saved, const Sides& sides, btPersistentManifold& manifold, int found);

  std::deque<Node> nodes_;  // grows without copies and spare room
  std::vector<std::int32_t> free_;
  std::vector<std::int32_t> first_;  // by owner; -1: none
  std::vector<SavedPoint> saved_;    // scratch
  std::vector<std::pair<btBroadphaseProxy*, btBroadphaseProxy*>> announced_;
  btManifoldArray manifolds_;  // scratch
};

}  // namespace talus::bullet
