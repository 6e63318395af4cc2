#pragma once
// Where two of Bullet's objects will touch within a step.

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "common/solver/fast_bodies.h"

namespace talus::bullet {

/// An object and how it goes on in the step, in Bullet's axes.
struct Mover {
  const btCollisionObject* object = nullptr;
  StepMotion<3> motion;
  float turn = 0.0F;  // way of its farthest point around its centre at most [m]

  btTransform after(float share) const;
};

/// Of all places to which the object may come.
struct SweptBox {
  btVector3 low;
  btVector3 high;
};
SweptBox swept(const Mover& mover);

/// Appends the points where two objects, none of them a plane, first get nearer than `near` [m] within the step, and
/// those that may touch in the rest of it: piece by piece, with the gap at the start and the arms of then.
void meet(const Mover& a, const Mover& b, float near, std::vector<ContactPoint<3>>& found);

}  // namespace talus::bullet
