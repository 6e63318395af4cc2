#pragma once
// Between the vectors of Box2D, those of talus and those of its solver. All are (x, z) with z up.

#include <box2d/box2d.h>

#include "common/math/angle.h"
#include "common/math/vector.h"
#include "common/solver/solver_body.h"

namespace talus::box2d {

inline b2Vec2 to_engine(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }
inline Vec2 from_engine(const b2Vec2& v) { return {v.x, v.y}; }

inline VecF<2> to_solver(const b2Vec2& v) { return {v.x, v.y}; }
inline b2Vec2 from_solver(const VecF<2>& v) { return {v.x(), v.y()}; }

/// An angle of any size brought into [-pi, pi], where single precision resolves it.
inline float engine_angle(double angle) { return static_cast<float>(wrapped(angle)); }

inline bool is_dynamic(const b2Body& body) { return body.GetType() == b2_dynamicBody; }

}  // namespace talus::box2d
