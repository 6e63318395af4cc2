#pragma once
// Convex pieces as Box2D shapes.

#include <box2d/box2d.h>

#include <variant>
#include <vector>

#include "common/shape/shape.h"

namespace talus::box2d {

/// A convex piece in Box2D.
using EnginePiece = std::variant<b2CircleShape, b2PolygonShape>;

inline const b2Shape& base(const EnginePiece& piece) {
  return std::visit([](const auto& one) -> const b2Shape& { return one; }, piece);
}

/// The pieces of a shape, in their order; a capsule becomes two discs and the rectangle between.
std::vector<EnginePiece> engine_pieces(const Shape<2>& shape);

/// The same piece after the motion `pose`. Corners keep their order.
EnginePiece moved(const EnginePiece& piece, const b2Transform& pose);

}  // namespace talus::box2d
