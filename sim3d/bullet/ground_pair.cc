#include "sim3d/bullet/ground_pair.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>

namespace talus::bullet {

// The dispatcher takes memory for algorithms from a pool whose places are as large as Bullet's largest.
static_assert(sizeof(GroundPair) <= sizeof(btCompoundCompoundCollisionAlgorithm));

btCollisionAlgorithm* GroundPair::Maker::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                  const btCollisionObjectWrapper* first,
                                                                  const btCollisionObjectWrapper* second) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(GroundPair)))
      GroundPair(info, first, second, *this);
}

void GroundPair::processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                                  const btDispatcherInfo& info, btManifoldResult* result) {
  if (!in_flight(m_isSwapped ? *second : *first, m_isSwapped ? *first : *second))
    btCompoundCollisionAlgorithm::processCollision(first, second, info, result);
}

/// Whether Bullet would neither find nor drop a point. Its first look is never left out, since it makes the manifolds,
/// whose order decides the order in which the solver takes the contacts.
bool GroundPair::in_flight(const btCollisionObjectWrapper& body, const btCollisionObjectWrapper& ground) const {
  btManifoldArray& manifolds = maker_.manifolds;
  manifolds.resize(0);
  for (int i = 0; i < m_childCollisionAlgorithms.size(); ++i) {
    if (m_childCollisionAlgorithms[i] == nullptr) return false;
    m_childCollisionAlgorithms[i]->getAllContactManifolds(manifolds);
  }
  const auto& plane = *static_cast<const btStaticPlaneShape*>(ground.getCollisionShape());
  const btScalar gap = body.getCollisionObject()->getBroadphaseHandle()->m_aabbMin.z() - plane.getPlaneConstant();
  for (int i = 0; i < manifolds.size(); ++i)
    if (manifolds[i]->getNumContacts() > 0 || gap <= manifolds[i]->getContactBreakingThreshold()) return false;
  return true;
}

}  // namespace talus::bullet
