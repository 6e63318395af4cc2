#pragma once
// What a user's polygon must be like.

#include <span>

#include "common/math/vector.h"

namespace talus {

/// Throws std::invalid_argument with field, value and rule unless the corners, in order and either way round, make a
/// simple polygon: at least 3, finite, no edge touching another but its neighbours in their common corner.
void check_simple_polygon(std::span<const Vec2> corners);

}  // namespace talus
