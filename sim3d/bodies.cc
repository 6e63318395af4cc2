#include "sim3d/bodies.h"

namespace talus::bullet {
namespace {

void set_common(btCollisionObject& object, const Surface& surface, BodyIndex index) {
  object.setFriction(surface.friction);
  object.setRestitution(surface.restitution);
  object.setUserIndex(index);
}

}  // namespace

RigidBodyMaker::~RigidBodyMaker() {
  for (void* memory : spare_) btAlignedFree(memory);
}

std::unique_ptr<btRigidBody> RigidBodyMaker::make(const BodyTemplate& shape, const btTransform& place, BodyIndex index,
                                                  bool may_sleep) {
  // As the body's own operator new does, so that its operator delete can free it.
  if (spare_.empty()) spare_.push_back(btAlignedAlloc(sizeof(btRigidBody), 16));
  btRigidBody::btRigidBodyConstructionInfo info(shape.mass, nullptr, shape.whole, shape.inertia);
  info.m_startWorldTransform = place;
  std::unique_ptr<btRigidBody> body(::new (spare_.back()) btRigidBody(info));
  spare_.pop_back();
  body->setLinearFactor(shape.linear_factor);
  body->setAngularFactor(shape.angular_factor);
  set_common(*body, shape.surface, index);
  if (!may_sleep) body->setActivationState(DISABLE_DEACTIVATION);
  // Bullet sweeps a body only in steps in which it moves further than this, so slow ones pay nothing.
  body->setCcdMotionThreshold(shape.sweep_from);
  body->setCcdSweptSphereRadius(shape.inner_radius);
  return body;
}

void RigidBodyMaker::retire(std::unique_ptr<btCollisionObject> object) {
  if (btRigidBody* body = btRigidBody::upcast(object.get()); body != nullptr) {
    object.release();  // NOLINT(bugprone-unused-return-value): it is `body`
    body->~btRigidBody();
    spare_.push_back(body);
  }
}

std::unique_ptr<btCollisionObject> make_static_object(btCollisionShape& shape, const Surface& surface,
                                                      const btTransform& place, BodyIndex index) {
  auto object = std::make_unique<btCollisionObject>();
  object->setCollisionShape(&shape);
  object->setWorldTransform(place);
  object->setInterpolationWorldTransform(place);
  object->forceActivationState(ISLAND_SLEEPING);
  set_common(*object, surface, index);
  return object;
}

bool images_meet(const btCollisionObject& a, const btCollisionObject& b) {
  if (a.getUserIndex() < 0) return image_of(b).sides == 0;
  if (b.getUserIndex() < 0) return image_of(a).sides == 0;
  return (image_of(a).sides & image_of(b).sides) == 0;
}

bool MeetingOfImages::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  if ((a->m_collisionFilterGroup & b->m_collisionFilterMask) == 0 ||
      (b->m_collisionFilterGroup & a->m_collisionFilterMask) == 0)
    return false;
  return images_meet(*static_cast<const btCollisionObject*>(a->m_clientObject),
                     *static_cast<const btCollisionObject*>(b->m_clientObject));
}

std::unique_ptr<btCollisionObject> make_moving_obstacle(const BodyTemplate& shape, const btTransform& place,
                                                        BodyIndex index) {
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape.whole);
  info.m_startWorldTransform = place;
  auto body = std::make_unique<btRigidBody>(info);
  body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  body->setActivationState(DISABLE_DEACTIVATION);
  set_common(*body, shape.surface, index);
  return body;
}

}  // namespace talus::bullet
