#pragma once
// The impulses that are stored in a contact point of Bullet.

#include <btBulletDynamicsCommon.h>

#include <cstdint>

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

/// Whether the collision detection has not found a point again since it was put back: in a field that only Bullet's own
/// solver uses, and that begins anew when Bullet finds the point.
inline void set_unconfirmed(btManifoldPoint& point) { point.m_contactERP = 1; }
inline bool is_unconfirmed(const btManifoldPoint& point) { return point.m_contactERP != 0; }

/// Which rolling impulse a point has: an entry of a list that small steps keep from one step to the next.
struct PointMark {
  std::uint32_t step = 0;  // number of the step that made the list; 0: none
  std::uint32_t entry = 0;
};
static_assert(sizeof(std::uintptr_t) == 8);

/// In a field that Bullet keeps when it finds the point again; it calls nothing when the point ends.
inline void set_mark(btManifoldPoint& point, const PointMark& mark) {
  const std::uintptr_t both = (std::uintptr_t{mark.step} << 32U) | mark.entry;
  point.m_userPersistentData = reinterpret_cast<void*>(both);  // NOLINT(performance-no-int-to-ptr)
}
inline PointMark mark_of(const btManifoldPoint& point) {
  const auto both = reinterpret_cast<std::uintptr_t>(point.m_userPersistentData);
  return {static_cast<std::uint32_t>(both >> 32U), static_cast<std::uint32_t>(both)};
}

}  // namespace talus::bullet
