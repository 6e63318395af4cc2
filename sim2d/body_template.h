#pragma once
// What all bodies of one shape have in common in Box2D.

#include <box2d/box2d.h>

#include <span>
#include <variant>
#include <vector>

#include "common/shape/shape.h"
#include "common/world/body.h"
#include "common/world/world_description.h"

namespace talus::box2d {

/// Friction and restitution of a fixture; density 0, since a body's mass is set as a whole. Box2D mixes friction by the
/// geometric mean, as we do.
b2FixtureDef fixture_of(const Material& material, const SolverParams& solver);

/// A convex piece in Box2D.
using EnginePiece = std::variant<b2CircleShape, b2PolygonShape>;

inline const b2Shape& base(const EnginePiece& piece) {
  return std::visit([](const auto& one) -> const b2Shape& { return one; }, piece);
}

/// What Box2D adds around polygons and lines [m]. Its own solver keeps it between bodies; under small steps discs have
/// it too, and bodies touch without it: contacts are known so long before, and none is lost while a body lifts by less.
inline constexpr float skin = b2_polygonRadius;

/// The pieces of a shape, in their order; a capsule becomes two discs and the rectangle between.
std::vector<EnginePiece> engine_pieces(const Shape<2>& shape, const SolverParams& solver);

/// The same piece after the motion `pose`. Corners keep their order.
EnginePiece moved(const EnginePiece& piece, const b2Transform& pose);

/// Gives a body the pieces, with tags of the owner. `as` has all else of the fixtures. Returns the last; the others
/// follow by GetNext().
b2Fixture* attach(b2Body& body, b2FixtureDef as, std::span<const EnginePiece> pieces, BodyIndex owner);

/// All that a body of one Shape needs from it; made once and shared by its bodies.
struct BodyTemplate {
  std::vector<EnginePiece> pieces;
  b2FixtureDef material;  // of all fixtures; without shape and user data
  b2MassData mass;        // and inertia about the origin, which is the centre of mass
};

BodyTemplate make_body_template(const Shape<2>& shape, const SolverParams& solver);

}  // namespace talus::box2d
