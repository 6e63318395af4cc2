#pragma once
// Where two fixtures will touch within a step.

#include <box2d/box2d.h>

#include <optional>

#include "common/solver/fast_bodies.h"

namespace talus::box2d {

/// A fixture and how its body goes on in the step.
struct Mover {
  b2Fixture* fixture = nullptr;
  StepMotion<2> motion;
  float turn = 0.0F;         // way of its farthest point around the body's centre at most [m]
  StepMotion<2> drift = {};  // what Box2D's pose of the body already contains of the motion

  b2Transform after(float share) const;
};

/// The box of all places to which the fixture may come.
b2AABB swept(const Mover& mover);

/// The first touch of two discs or polygons.
struct Meeting {
  Mover a;
  Mover b;
  float share = 0.0F;  // of the step
  b2Manifold manifold;
  b2WorldManifold place;  // where the bodies are then
};

/// None: they do not get nearer than `near` [m] within the step. The manifold has the points too that come near in the
/// rest of it.
std::optional<Meeting> meet(const Mover& one, const Mover& other, float near);

}  // namespace talus::box2d
