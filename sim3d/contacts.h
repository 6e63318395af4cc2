#pragma once
// The contact points of Bullet as talus::Contact.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <span>
#include <utility>
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

  /// Before a step whose contacts may be gathered: notes the velocities, from which the approach speeds follow.
  /// `bodies` are those that stand one after the other in Bullet's list.
  void note_motion(std::span<btRigidBody* const> bodies, std::span<btRigidBody* const> moving_obstacles);

  /// After a step: appends its contacts, see World::contacts(). `asleep`: by body.
  void gather(const Engine& engine, std::span<const std::uint8_t> asleep, std::vector<Contact<Dim>>& contacts) const;

 private:
  struct Motion {
    explicit Motion(const btRigidBody& body) : velocity(body.getLinearVelocity()), spin(body.getAngularVelocity()) {}
    Motion() = default;
    btVector3 velocity = btVector3(0, 0, 0);
    btVector3 spin = btVector3(0, 0, 0);
    btVector3 at(const btCollisionObject& object, const btVector3& point) const {
      return velocity + spin.cross(point - object.getWorldTransform().getOrigin());
    }
  };
  /// The contact of a pair, or of two of its pieces, and its bodies in the order of the result.
  struct Touch {
    const btPersistentManifold* manifold = nullptr;
    const btCollisionObject* a = nullptr;
    const btCollisionObject* b = nullptr;
    bool swap = false;  // b is Bullet's first
  };
  /// Where a touch comes in the result. The manifolds' order depends on the history of pairs; those of one pair keep
  /// theirs.
  struct Place {
    std::int64_t pair = 0;
    std::size_t touch = 0;
    auto operator<=>(const Place&) const = default;
  };
  void find_touches(const Engine& engine, std::span<const std::uint8_t> asleep) const;
  void append(const Touch& touch, std::vector<Contact<Dim>>& contacts) const;
  Motion motion_before(const btCollisionObject& object) const;

  mutable std::vector<Touch> touches_;                                  // scratch
  mutable std::vector<Place> places_;                                   // scratch: of the touches
  std::vector<Motion> motion_;                                          // before the step
  std::vector<std::pair<const btCollisionObject*, Motion>> obstacles_;  // those that move, in the step
  int first_ = 0;        // place of the first body of motion_ in Bullet's list
  double impulse_unit_;  // [N s]
  bool small_steps_;
};

}  // namespace talus::bullet
