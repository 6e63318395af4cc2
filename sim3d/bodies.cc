#include "sim3d/bodies.h"

namespace talus::bullet {
namespace {

void set_common(btCollisionObject& object, btScalar friction, btScalar restitution, BodyIndex index) {
  object.setFriction(friction);
  object.setRestitution(restitution);
  object.setUserIndex(index);
}

}  // namespace

std::unique_ptr<btRigidBody> make_rigid_body(const EngineShape& shape, const btTransform& place, BodyIndex index,
                                             bool may_sleep) {
  btRigidBody::btRigidBodyConstructionInfo info(shape.mass, nullptr, shape.whole, shape.inertia);
  info.m_startWorldTransform = place;
  auto body = std::make_unique<btRigidBody>(info);
  body->setLinearFactor(shape.linear_factor);
  body->setAngularFactor(shape.angular_factor);
  set_common(*body, shape.friction, shape.restitution, index);
  if (!may_sleep) {
    body->setActivationState(DISABLE_DEACTIVATION);
  }
  // Bullet sweeps a body only in steps in which it moves further than this, so slow ones pay nothing.
  body->setCcdMotionThreshold(shape.sweep_from);
  body->setCcdSweptSphereRadius(shape.inner_radius);
  return body;
}

std::unique_ptr<btCollisionObject> make_static_object(btCollisionShape& shape, btScalar friction, btScalar restitution,
                                                      const btTransform& place, BodyIndex index) {
  auto object = std::make_unique<btCollisionObject>();
  object->setCollisionShape(&shape);
  object->setWorldTransform(place);
  object->setInterpolationWorldTransform(place);
  object->forceActivationState(ISLAND_SLEEPING);
  set_common(*object, friction, restitution, index);
  return object;
}

}  // namespace talus::bullet
