#pragma once
// Whether two boxes are apart, told from where they were apart before.

#include <btBulletCollisionCommon.h>

#include <cstdint>

namespace talus::bullet {

/// Number of an edge direction: 0 to 2 of the first box, 3 to 5 of the second; -1: none.
using BoxAxis = std::int8_t;

/// Whether the boxes' shadows on this axis (not -1) are apart by more than the rounding of any test of it.
bool apart_along(BoxAxis axis, const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                 const btTransform& second_place);

/// An axis along which they are apart; -1 where there is none, though they may still be apart along a direction
/// across two of their edges. (Gottschalk, Lin and Manocha 1996, "OBBTree", section 5.)
BoxAxis separating_axis(const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                        const btTransform& second_place);

}  // namespace talus::bullet
