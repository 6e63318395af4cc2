#include "sim3d/body_swap.h"

namespace talus::bullet {

void BodySwap::freeze(std::unique_ptr<btCollisionObject>& object, const BodyTemplate& shape, btScalar stray) {
  prepare_broadphase();
  btBroadphaseProxy* proxy = object->getBroadphaseHandle();
  proxy->m_collisionFilterGroup = btBroadphaseProxy::StaticFilter;
  proxy->m_collisionFilterMask = btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter;
  for (btBroadphaseProxy* partner : engine_.pairs.static_partners(proxy)) {
    warm_start_.save(*engine_.pairs.findPair(proxy, partner));
    engine_.pairs.removeOverlappingPair(proxy, partner, &engine_.dispatcher);
  }
  auto frozen = make_static_object(*shape.whole, shape.surface, object->getWorldTransform(), object->getUserIndex());
  frozen->setUserPointer(const_cast<BodyTemplate*>(&shape));  // of a frozen body: its mass
  exchange(object, std::move(frozen));
  if (stray > 0) set_box(*object, gContactBreakingThreshold + stray);
}

void BodySwap::thaw(std::unique_ptr<btCollisionObject>& object, const BodyTemplate& shape, bool may_sleep) {
  std::unique_ptr<btRigidBody> body =
      engine_.rigid_bodies.make(shape, object->getWorldTransform(), object->getUserIndex(), may_sleep);
  body->setGravity(engine_.world.getGravity());
  exchange(object, std::move(body));
  btBroadphaseProxy* proxy = object->getBroadphaseHandle();
  proxy->m_collisionFilterGroup = btBroadphaseProxy::DefaultFilter;
  proxy->m_collisionFilterMask = btBroadphaseProxy::AllFilter;
  // Makes the pairs with static neighbours. The box is the one that the next step will use.
  set_box(*object, gContactBreakingThreshold);
  warm_start_.announce(*proxy, engine_.pairs);
}

void BodySwap::set_box(const btCollisionObject& object, btScalar margin) {
  btVector3 low;
  btVector3 high;
  object.getCollisionShape()->getAabb(object.getWorldTransform(), low, high);
  const btVector3 around(margin, margin, margin);
  auto* proxy = const_cast<btBroadphaseProxy*>(object.getBroadphaseHandle());
  engine_.broadphase.setAabbForceUpdate(proxy, low - around, high + around, &engine_.dispatcher);
}

// The manifolds that stay must point to the new object.
void BodySwap::exchange(std::unique_ptr<btCollisionObject>& object, std::unique_ptr<btCollisionObject> successor) {
  btBroadphaseProxy* proxy = object->getBroadphaseHandle();
  successor->setBroadphaseHandle(proxy);
  set_image(*successor, image_of(*object));
  for (btBroadphaseProxy* partner : engine_.pairs.partners(proxy)) {
    btBroadphasePair* pair = engine_.pairs.findPair(proxy, partner);
    if (pair->m_algorithm != nullptr) {
      manifolds_.resize(0);
      pair->m_algorithm->getAllContactManifolds(manifolds_);
      for (int i = 0; i < manifolds_.size(); ++i) {
        const btCollisionObject* first = manifolds_[i]->getBody0();
        const btCollisionObject* second = manifolds_[i]->getBody1();
        manifolds_[i]->setBodies(first == object.get() ? successor.get() : first,
                                 second == object.get() ? successor.get() : second);
      }
    }
  }
  proxy->m_clientObject = successor.get();
  engine_.pairs.forget_place(proxy);
  std::swap(object, successor);
  engine_.rigid_bodies.retire(std::move(successor));
}

// With sleepers around, Bullet would rebalance one in a hundred entries of its tree of resting bodies in each step.
// One entry a step is enough. Not before the first freeze, so that a run without sleepers is plain Bullet's.
void BodySwap::prepare_broadphase() { engine_.broadphase.m_fupdates = 0; }

}  // namespace talus::bullet
