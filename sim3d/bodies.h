#pragma once
// A body's two forms in Bullet.

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "common/world/body.h"
#include "sim3d/body_template.h"

namespace talus::bullet {

/// Awake bodies, each made in the memory of one that fell asleep where there is any. Left to the heap, that memory
/// would be cut up for sleepers and the rest of it lost: half a kilobyte a sleeper.
class RigidBodyMaker {
 public:
  RigidBodyMaker() = default;
  RigidBodyMaker(const RigidBodyMaker&) = delete;
  RigidBodyMaker& operator=(const RigidBodyMaker&) = delete;
  ~RigidBodyMaker();

  /// A rigid body at rest. `may_sleep`: whether Bullet's own sleeping applies to it.
  std::unique_ptr<btRigidBody> make(const BodyTemplate& shape, const btTransform& place, BodyIndex index,
                                    bool may_sleep);

  /// Ends a rigid body and keeps its memory; other objects just end.
  void retire(std::unique_ptr<btCollisionObject> object);

 private:
  std::vector<void*> spare_;
};

/// Asleep, and the form of ground and obstacles too: a bare collision object, half as large as a rigid body and
/// without mass, velocity or any work in a step.
std::unique_ptr<btCollisionObject> make_static_object(btCollisionShape& shape, const Surface& surface,
                                                      const btTransform& place, BodyIndex index);

/// What a body is an image of; frozen and awake form of a body have the same.
inline void set_image(btCollisionObject& object, const Image& image) {
  object.setUserIndex2(image.sides);
  object.setUserIndex3(image.of);
}
/// Of ground and obstacles it means nothing.
inline Image image_of(const btCollisionObject& object) {
  return object.getUserIndex2() > 0 ? Image{object.getUserIndex3(), object.getUserIndex2()}
                                    : Image{object.getUserIndex(), 0};
}

/// Whether two objects may touch, see Image.
bool images_meet(const btCollisionObject& a, const btCollisionObject& b);

/// Which pairs collide in a world with images: Bullet's own rule and that of Image.
struct MeetingOfImages final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
};

/// An obstacle that moves by plan, with the velocity that it is given for each step.
std::unique_ptr<btCollisionObject> make_moving_obstacle(const BodyTemplate& shape, const btTransform& place,
                                                        BodyIndex index);

}  // namespace talus::bullet
