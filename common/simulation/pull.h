#pragma once
// A body pulled along by hand.

#include "common/policy/sleep_policy.h"
#include "common/world/world.h"

namespace talus {

/// A spring from a point of a body to a place.
template <int Dim>
struct Pull {
  BodyIndex body = 0;
  Vec<Dim> point = Vec<Dim>::Zero();   // in the body's own axes [m]
  Vec<Dim> target = Vec<Dim>::Zero();  // [m]
};

/// Force of the spring, in weights of the body, where it is stretched by the body's extent D. That is also the farthest
/// that it stretches, so the body moves at 2.2 sqrt(g D) at most, as after a fall from 2.5 D.
inline constexpr double pull_stiffness = 20.0;

/// The velocity that a critically damped spring gives an awake body over the next `dt` [s], solved implicitly, so that
/// it is stable at any step (Box2D 2.4.1, b2_mouse_joint.cpp). The world's gravity scales its force; 0 counts as 1.
template <int Dim>
VelocityChange<Dim> pulled(const World<Dim>& world, const Pull<Dim>& pull, double dt);

}  // namespace talus
