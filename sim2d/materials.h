#pragma once
// Materials as Box2D mixes them.

#include <box2d/box2d.h>

#include "common/world/world_description.h"

namespace talus::box2d {

/// Friction and restitution of a fixture; density 0, since a body's mass is set as a whole. Box2D mixes friction by the
/// geometric mean, as we do.
b2FixtureDef fixture_of(const Material& material, const SolverParams& solver);

/// Whether restitutions differ, so that Box2D's rule (the larger wins) must be replaced contact by contact.
bool restitutions_differ(const WorldDescription<2>& description);

/// Sets the geometric mean of both restitutions on a contact; it stays until the contact ends.
void mix_restitution(b2Contact& contact);

}  // namespace talus::box2d
