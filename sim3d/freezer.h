#pragma once
// Freezing and thawing.

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "sim3d/bodies.h"
#include "sim3d/engine.h"

namespace talus::bullet {

/// Exchanges a body's awake form for its sleeping one and back, within its broadphase entry. Contacts with awake
/// neighbours are kept with their impulses. Contacts with static ones (ground, obstacles, sleepers) go when the body
/// freezes, since pairs exist only where at least one side is awake, and are found anew in the first step after it
/// thaws. Cost: the body's own neighbours.
class Freezer {
 public:
  explicit Freezer(Engine& engine) : engine_(engine) {}

  /// `object` holds a rigid body on entry and a static object after.
  void freeze(std::unique_ptr<btCollisionObject>& object, const EngineShape& shape);

  /// The other way round; the body is at rest.
  void thaw(std::unique_ptr<btCollisionObject>& object, const EngineShape& shape, bool may_sleep);

 private:
  void exchange(std::unique_ptr<btCollisionObject>& object, std::unique_ptr<btCollisionObject> successor);
  void prepare_broadphase();

  Engine& engine_;
  btManifoldArray manifolds_;  // scratch
};

}  // namespace talus::bullet
