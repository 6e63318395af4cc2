#pragma once
// The contact points of Bullet as talus::Contact.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <span>
#include <vector>

#include "common/world/body.h"
#include "sim3d/engine.h"

namespace talus::bullet {

/// Gathers the contacts that touch or carry an impulse.
template <int Dim>
class Contacts {
 public:
  /// `mass_scale`: of the world; impulses are divided by it. `small_steps`: whether SmallSteps solves them.
  Contacts(double mass_scale, bool small_steps) : impulse_unit_(1.0 / mass_scale), small_steps_(small_steps) {}

  /// Before a step whose contacts will be gathered: notes the velocities, from which the approach speeds follow.
  /// `bodies` are those that stand one after the other in Bullet's list.
  void note_motion(std::span<btRigidBody* const> bodies);

  /// After a step: appends its contacts, see World::contacts().
  void gather(const Engine& engine, std::vector<Contact<Dim>>& contacts);

 private:
  struct Motion {
    btVector3 velocity = btVector3(0, 0, 0);
    btVector3 spin = btVector3(0, 0, 0);
    btVector3 at(const btCollisionObject& object, const btVector3& point) const {
      return velocity + spin.cross(point - object.getWorldTransform().getOrigin());
    }
  };
  /// The contact of a pair, or of two of its pieces, and its bodies in the order of the result.
  struct Touch {
    std::int64_t place = 0;  // in the order of pairs
    const btPersistentManifold* manifold = nullptr;
    const btCollisionObject* a = nullptr;
    const btCollisionObject* b = nullptr;
    bool swap = false;  // b is Bullet's first
  };
  void find_touches(const Engine& engine);
  void append(const Touch& touch, std::vector<Contact<Dim>>& contacts) const;
  Motion motion_before(const btCollisionObject& object) const;

  std::vector<Touch> touches_;  // scratch
  std::vector<Motion> motion_;  // before the step
  int first_ = 0;               // place of the first body of motion_ in Bullet's list
  double impulse_unit_;         // [N s]
  bool small_steps_;
};

}  // namespace talus::bullet
