#pragma once
// A body or an obstacle as Bullet's collision algorithms take it.

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletCollisionCommon.h>

namespace talus::bullet {

/// All of it, and not one of its pieces.
inline btCollisionObjectWrapper whole(const btCollisionObject& object) {
  return btCollisionObjectWrapper(nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1);
}

}  // namespace talus::bullet
