#include "sim3d/bullet/rebound.h"

#include <algorithm>

namespace talus::bullet {
namespace {

btVector3 velocity_at(const btCollisionObject& object, const btVector3& place) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  if (body == nullptr) return {0, 0, 0};
  return body->getVelocityInLocalPoint(place - body->getWorldTransform().getOrigin());
}

/// The restitution with which the point's surfaces part at `restitution` times `approach`.
btScalar corrected(btScalar restitution, btScalar gap, btScalar approach, const btContactSolverInfo& info,
                   btScalar dt) {
  if (approach <= 0) return restitution;
  if (gap > 0) return approach * dt > gap ? restitution + gap / (dt * approach) : 0;
  const btScalar given = gap > info.m_splitImpulsePenetrationThreshold ? -gap * info.m_erp2 / dt : 0;
  return std::max(btScalar(0), restitution - given / approach);
}

}  // namespace

void set_rebounds(btDispatcher& dispatcher, const btContactSolverInfo& info, btScalar dt) {
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const btCollisionObject& a = *manifold.getBody0();
    const btCollisionObject& b = *manifold.getBody1();
    const btScalar restitution = a.getRestitution() * b.getRestitution();
    if (restitution == 0) continue;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      btManifoldPoint& point = manifold.getContactPoint(i);
      const btVector3 velocity =
          velocity_at(a, point.getPositionWorldOnA()) - velocity_at(b, point.getPositionWorldOnB());
      point.m_combinedRestitution =
          corrected(restitution, point.getDistance(), -point.m_normalWorldOnB.dot(velocity), info, dt);
    }
  }
}

}  // namespace talus::bullet
