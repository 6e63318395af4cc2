#pragma once
// The friction impulse that is stored in a contact point of Bullet.

#include <btBulletDynamicsCommon.h>

namespace talus::bullet {

/// On the first body, in the world's axes [N s].
inline btVector3 friction_impulse(const btManifoldPoint& point) {
  return point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1 +
         point.m_lateralFrictionDir2 * point.m_appliedImpulseLateral2;
}

/// In the directions of btPlaneSpace1, which Bullet gives a point that it finds again in the next step.
inline void set_friction_impulse(btManifoldPoint& point, const btVector3& impulse) {
  btPlaneSpace1(point.m_normalWorldOnB, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
  point.m_appliedImpulseLateral1 = impulse.dot(point.m_lateralFrictionDir1);
  point.m_appliedImpulseLateral2 = impulse.dot(point.m_lateralFrictionDir2);
}

}  // namespace talus::bullet
