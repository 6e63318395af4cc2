#pragma once
// Contacts between two bodies of several pieces.

#include <btBulletCollisionCommon.h>

#include <utility>
#include <vector>

#include "sim3d/bullet/separation.h"

namespace talus::bullet {

/// Finds the contacts of two compound shapes, to the bit as Bullet 3.24 does (btCompoundCompoundCollisionAlgorithm),
/// which piles of such bodies spend a third of their time in: there each call builds and drops four contact manifolds
/// on the stack, and each new pair asks for memory ten times. Two boxes that do not touch and are apart along the same
/// axis as in the last step are left alone, and with them the memory of their algorithm and manifold. The order in
/// which pieces meet, come and go is Bullet's, since it decides the order in which the solver takes the contacts.
class CompoundPair final : public btCollisionAlgorithm {
 public:
  struct Maker;
  CompoundPair(btDispatcher* dispatcher, Maker& maker) : maker_(maker) { m_dispatcher = dispatcher; }
  CompoundPair(const CompoundPair&) = delete;
  CompoundPair& operator=(const CompoundPair&) = delete;
  ~CompoundPair() override;

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;  // as all of Bullet's: nothing uses it
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override;

  /// What Bullet's dispatcher calls for a new pair.
  struct Maker final : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* first,
                                                   const btCollisionObjectWrapper* second) override;
    btManifoldArray manifolds;  // scratch of all pairs
    std::vector<std::pair<int, int>> parted;
  };

 private:
  /// Two pieces whose bounding boxes overlap.
  struct PiecePair {
    int first;
    int second;
    btCollisionAlgorithm* algorithm;
    bool overlaps;          // in this step
    bool may_touch = true;  // false: its manifold is known to be empty, and need not be looked at
    BoxAxis apart = -1;     // of two boxes: where they were apart last
  };
  struct Visit;

  void refresh(btManifoldResult& result);
  void descend(const btDbvtNode& first, const btDbvtNode& second, const Visit& visit);
  void meet(int first, int second, const Visit& visit);
  bool touch(const PiecePair& pair);
  PiecePair& add(int first, int second, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b);
  std::vector<PiecePair>::iterator find(int first, int second);
  void part(const Visit& visit);
  void destroy(btCollisionAlgorithm* algorithm);

  Maker& maker_;
  std::vector<PiecePair> pieces_;
};

}  // namespace talus::bullet
