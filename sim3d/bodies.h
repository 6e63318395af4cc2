#pragma once
// A body's two forms in Bullet.

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "common/world/body.h"
#include "sim3d/shapes.h"

namespace talus::bullet {

/// Awake: a rigid body at rest. `may_sleep`: whether Bullet's own sleeping applies to it.
std::unique_ptr<btRigidBody> make_rigid_body(const EngineShape& shape, const btTransform& place, BodyIndex index,
                                             bool may_sleep);

/// Asleep, and the form of ground and obstacles too: a bare collision object, half as large as a rigid body and
/// without mass, velocity or any work in a step.
std::unique_ptr<btCollisionObject> make_static_object(btCollisionShape& shape, btScalar friction, btScalar restitution,
                                                      const btTransform& place, BodyIndex index);

}  // namespace talus::bullet
