#pragma once
// Contacts between a body of several pieces and the ground.

#include <BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h>
#include <btBulletCollisionCommon.h>

namespace talus::bullet {

/// Finds the contacts of a compound shape with a horizontal plane as Bullet does, but leaves out bodies in flight. To
/// Bullet a plane's bounding box has no end, so each body makes a pair with the ground however high it is, and working
/// on that pair is a third of what a body in flight costs.
class GroundPair final : public btCompoundCollisionAlgorithm {
 public:
  /// What Bullet's dispatcher calls for a new pair.
  struct Maker final : btCollisionAlgorithmCreateFunc {
    explicit Maker(bool ground_is_first) : ground_first(ground_is_first) {}
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* first,
                                                   const btCollisionObjectWrapper* second) override;
    bool ground_first;
    btManifoldArray manifolds;  // scratch of all pairs
  };

  GroundPair(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
             const btCollisionObjectWrapper* second, Maker& maker)
      : btCompoundCollisionAlgorithm(info, first, second, maker.ground_first), maker_(maker) {}

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo& info, btManifoldResult* result) override;

 private:
  bool in_flight(const btCollisionObjectWrapper& body, const btCollisionObjectWrapper& ground) const;

  Maker& maker_;
};

}  // namespace talus::bullet
