#include "sim3d/states.h"

#include <cmath>

#include "sim3d/plane.h"

namespace talus::bullet {

bool is_sound(const btRigidBody& body) {
  // A sum is finite only if all its parts are (or nearly overflow, which is no better).
  const btVector3 sum = body.getWorldTransform().getOrigin() + body.getWorldTransform().getBasis().getRow(0) +
                        body.getWorldTransform().getBasis().getRow(1) + body.getWorldTransform().getBasis().getRow(2) +
                        body.getLinearVelocity() + body.getAngularVelocity();
  return std::isfinite(sum.x() + sum.y() + sum.z()) && body.getActivationState() != DISABLE_SIMULATION;
}

template <int Dim>
void append_state(BodyStates<Dim>& states, const BodyDef<Dim>& body) {
  states.shape.push_back(body.shape);
  states.pose.push_back(body.pose);
  states.velocity.push_back(body.velocity);
  states.spin.push_back(body.spin);
  states.asleep.push_back(0);
  states.removed.push_back(0);
}

template <int Dim>
void read_state(const btRigidBody& body, const EngineShape& shape, BodyStates<Dim>& states) {
  const auto i = static_cast<std::size_t>(body.getUserIndex());
  states.pose[i] = from_bullet<Dim>(body.getWorldTransform(), shape.frame_inverse);
  states.velocity[i] = from_bullet<Dim>(body.getLinearVelocity());
  states.spin[i] = spin_from_bullet<Dim>(body.getAngularVelocity());
}

template <int Dim>
void put_to_sleep(BodyStates<Dim>& states, BodyIndex body) {
  const auto i = static_cast<std::size_t>(body);
  states.velocity[i].setZero();
  states.spin[i].setZero();
  states.asleep[i] = 1;
}

template void append_state(BodyStates<2>&, const BodyDef<2>&);
template void append_state(BodyStates<3>&, const BodyDef<3>&);
template void read_state(const btRigidBody&, const EngineShape&, BodyStates<2>&);
template void read_state(const btRigidBody&, const EngineShape&, BodyStates<3>&);
template void put_to_sleep(BodyStates<2>&, BodyIndex);
template void put_to_sleep(BodyStates<3>&, BodyIndex);

}  // namespace talus::bullet
