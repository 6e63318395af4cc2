#pragma once
// The contact points of the last step.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <span>
#include <vector>

#include "common/world/body.h"
#include "sim3d/engine.h"

namespace talus::bullet {

/// Gathers the contacts that touch or carry an impulse, when asked. The velocities before a step, which the approach
/// speed needs, are kept from the first call of get() on: a run that never asks pays nothing, and the approach speeds
/// of its first answer are 0.
template <int Dim>
class Contacts {
 public:
  /// `mass_scale`: of the world, taken off the impulses again.
  explicit Contacts(double mass_scale) : impulse_unit_(1.0 / mass_scale) {}

  /// To be called before each step with the awake bodies, ascending.
  void before_step(std::span<btRigidBody* const> awake);
  /// To be called after each step.
  void after_step() { gathered_ = false; }

  std::span<const Contact<Dim>> get(const Engine& engine);

 private:
  struct Motion {
    btVector3 velocity = btVector3(0, 0, 0);
    btVector3 spin = btVector3(0, 0, 0);
    btVector3 at(const btCollisionObject& object, const btVector3& point) const {
      return velocity + spin.cross(point - object.getWorldTransform().getOrigin());
    }
  };
  /// The contact of a pair, or of two of its pieces, and its bodies in the order in which they are told.
  struct Touch {
    std::int64_t place = 0;  // in the order of pairs
    const btPersistentManifold* manifold = nullptr;
    const btCollisionObject* a = nullptr;
    const btCollisionObject* b = nullptr;
    bool swap = false;  // b is Bullet's first
  };
  void gather(const Engine& engine);
  void append(const Touch& touch);
  Motion motion_before(const btCollisionObject& object) const;

  std::vector<Contact<Dim>> contacts_;
  std::vector<Touch> touches_;     // scratch
  std::vector<Motion> motion_;     // before the step, of the awake bodies
  std::vector<BodyIndex> moving_;  // whose motion
  double impulse_unit_;            // [N s]
  bool keep_motion_ = false;
  bool gathered_ = false;
};

}  // namespace talus::bullet
