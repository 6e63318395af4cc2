#pragma once
// From Bullet's bodies to BodyStates.

#include <btBulletDynamicsCommon.h>

#include "common/world/body.h"
#include "sim3d/shapes.h"

namespace talus::bullet {

/// Whether Bullet still simulates the body and all its numbers are finite. Bullet takes a body whose bounding box is
/// not finite out of the simulation without a word.
bool is_sound(const btRigidBody& body);

/// Appends a new body.
template <int Dim>
void append_state(BodyStates<Dim>& states, const BodyDef<Dim>& body);

/// Copies pose and velocity of an awake body.
template <int Dim>
void read_state(const btRigidBody& body, const EngineShape& shape, BodyStates<Dim>& states);

/// At rest and asleep.
template <int Dim>
void put_to_sleep(BodyStates<Dim>& states, BodyIndex body);

}  // namespace talus::bullet
