#pragma once
// The contact points of the last step.

#include <btBulletDynamicsCommon.h>

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
  /// To be called before each step with the awake bodies, ascending.
  void before_step(std::span<btRigidBody* const> awake);
  /// To be called after each step.
  void after_step() { gathered_ = false; }

  std::span<const Contact<Dim>> get(const Engine& engine);

 private:
  struct Motion {
    btVector3 velocity = btVector3(0, 0, 0);
    btVector3 spin = btVector3(0, 0, 0);
  };
  void gather(const Engine& engine);
  void append(const btPersistentManifold& manifold);
  btVector3 velocity_before(const btCollisionObject& object, const btVector3& point) const;

  std::vector<Contact<Dim>> contacts_;
  std::vector<Motion> motion_;     // before the step, of the awake bodies
  std::vector<BodyIndex> moving_;  // whose motion
  bool keep_motion_ = false;
  bool gathered_ = false;
};

}  // namespace talus::bullet
