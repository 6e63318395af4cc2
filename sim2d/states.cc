#include "sim2d/states.h"

#include <cmath>

#include "sim2d/shapes.h"

namespace talus::box2d {

std::optional<BodyIndex> first_not_finite(std::span<const EngineBody> bodies, std::span<const BodyIndex> awake) {
  for (const BodyIndex index : awake) {
    const b2Body& body = *bodies[static_cast<std::size_t>(index)].body;
    const b2Vec2& position = body.GetPosition();
    const b2Vec2& velocity = body.GetLinearVelocity();
    // One sum instead of six tests: it is finite only if every term is.
    if (!std::isfinite(position.x + position.y + body.GetAngle() + velocity.x + velocity.y +
                       body.GetAngularVelocity())) {
      return index;
    }
  }
  return std::nullopt;
}

void read_states(std::span<const EngineBody> bodies, std::span<const BodyIndex> awake, BodyStates<2>& states) {
  for (const BodyIndex index : awake) {
    const auto i = static_cast<std::size_t>(index);
    const b2Body& body = *bodies[i].body;
    states.pose[i].position = from_engine(body.GetPosition());
    states.pose[i].rotation.angle() = body.GetAngle();
    states.velocity[i] = from_engine(body.GetLinearVelocity());
    states.spin[i][0] = body.GetAngularVelocity();
  }
}

}  // namespace talus::box2d
