#pragma once
// A body's change between its awake and its frozen form.

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <span>

#include "sim3d/bodies.h"
#include "sim3d/engine.h"
#include "sim3d/warm_start.h"

namespace talus::bullet {

/// Exchanges a body's awake form for its frozen one and back, within its broadphase entry. Contacts with awake
/// neighbours stay as they are. Contacts with static ones (ground, obstacles, frozen bodies) go when the body freezes,
/// since pairs exist only where at least one side is awake, and come back in the first step after it thaws. Cost: the
/// body's own neighbours.
class BodySwap {
 public:
  explicit BodySwap(Engine& engine) : engine_(engine) {}

  /// `object` holds a rigid body on entry and a static object after. `stray`: the largest displacement of the
  /// sleeping body from its pose in Bullet [m]; its box in the broad phase is larger by that.
  void freeze(std::unique_ptr<btCollisionObject>& object, const BodyTemplate& shape, btScalar stray);

  /// The other way round; the body is at rest.
  void thaw(std::unique_ptr<btCollisionObject>& object, const BodyTemplate& shape, bool may_sleep);

  /// To be called before a body wakes that took part in solves: see WarmStart::renew().
  void renew(const btCollisionObject& owner, std::span<const WarmStart::Renewed> points) {
    warm_start_.renew(owner, points);
  }

  /// To be called before a body leaves the world.
  void forget(BodyIndex body) { warm_start_.forget(body); }

  /// To be called after the collision detection of each step.
  void restore_contacts() { warm_start_.restore(engine_.pairs, engine_.world.getDispatchInfo()); }

 private:
  void exchange(std::unique_ptr<btCollisionObject>& object, std::unique_ptr<btCollisionObject> successor);
  void prepare_broadphase();
  void set_box(const btCollisionObject& object, btScalar margin);

  Engine& engine_;
  WarmStart warm_start_;
  btManifoldArray manifolds_;  // scratch
};

}  // namespace talus::bullet
