#pragma once
// The impulses that are stored in a contact point of Bullet.

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

/// Small steps (small_steps.h) store the impulses of the whole step beside those at which the next step starts: in
/// fields of the point that only Bullet's own solver uses.
inline void set_impulse_of_step(btManifoldPoint& point, btScalar normal, const btVector3& friction) {
  point.m_prevRHS = normal;
  point.m_contactMotion1 = friction.dot(point.m_lateralFrictionDir1);
  point.m_contactMotion2 = friction.dot(point.m_lateralFrictionDir2);
}
inline btScalar impulse_of_step(const btManifoldPoint& point) { return point.m_prevRHS; }
inline btVector3 friction_of_step(const btManifoldPoint& point) {
  return point.m_lateralFrictionDir1 * point.m_contactMotion1 + point.m_lateralFrictionDir2 * point.m_contactMotion2;
}

}  // namespace talus::bullet
