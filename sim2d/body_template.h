#pragma once
// What all bodies of one shape have in common in Box2D.

#include <box2d/box2d.h>

#include <vector>

#include "common/world/world_description.h"
#include "sim2d/pieces.h"

namespace talus::box2d {

/// All that a body of one Shape needs from it; made once and shared by its bodies.
struct BodyTemplate {
  std::vector<EnginePiece> pieces;
  b2FixtureDef material;  // of all fixtures; without shape and user data
  b2MassData mass;        // and inertia about the origin, which is the centre of mass
};

BodyTemplate make_body_template(const Shape<2>& shape, const SolverParams& solver);

}  // namespace talus::box2d
