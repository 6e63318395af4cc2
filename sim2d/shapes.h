#pragma once
// Our shapes as Box2D's.

#include <box2d/box2d.h>

#include <variant>
#include <vector>

#include "common/shape/shape.h"

namespace talus::box2d {

/// A convex piece as Box2D knows it.
using EngineShape = std::variant<b2CircleShape, b2PolygonShape>;

inline const b2Shape& base(const EngineShape& shape) {
  return std::visit([](const auto& one) -> const b2Shape& { return one; }, shape);
}

/// The engine shapes of all pieces, in their order; a capsule becomes two discs and the rectangle between.
std::vector<EngineShape> engine_shapes(const Shape<2>& shape);

/// The same shape in the axes that `pose` leads to. Corners keep their order.
EngineShape moved(const EngineShape& shape, const b2Transform& pose);

/// Mass and inertia about the origin, which is the centre of mass.
b2MassData engine_mass(const Shape<2>& shape);

inline b2Vec2 to_engine(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }
inline Vec2 from_engine(const b2Vec2& v) { return {v.x, v.y}; }

/// An angle of any size brought into [-pi, pi], where single precision resolves it.
float engine_angle(double angle);

}  // namespace talus::box2d
