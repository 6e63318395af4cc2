#pragma once
// How far two convex pieces are apart, or how deep in each other. Engines report contacts of awake bodies only;
// sleepers are measured by this.
//
// Why own code: libccd 2.1 is off by up to 0.1 m in 1 of 2,500 overlapping box pairs and finds no depth for 1 of 6
// boxes stacked flush; FCL 0.7 aborts on flush boxes; a growing hull (EPA) of our own met the same trouble with faces
// that are all but coplanar. Trying all separating axes and all pairs of features costs more for hulls of many corners
// (about the product of their edges) and has no such case.

#include <limits>

#include "common/math/vector.h"
#include "common/shape/convex_piece.h"

namespace talus {

/// Bodies that are nearer touch, in D: above the gap that Box2D keeps between polygons and the margin of Bullet's
/// boxes.
inline constexpr double touching_distance = 0.03;

/// Between the segments p1-q1 and p2-q2, either of which may be a point [m].
template <int Dim>
double segment_distance(const Vec<Dim>& p1, const Vec<Dim>& q1, const Vec<Dim>& p2, const Vec<Dim>& q2);

/// From a point to the triangle a, b, c [m].
double triangle_distance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

/// Distance between the two pieces [m]; where they overlap, minus the shortest way that parts them. Error below 1e-8 of
/// their size. For pieces at least `enough` [m] apart the result is some value not below `enough`.
template <int Dim>
double signed_distance(const ConvexPiece<Dim>& a, const ConvexPiece<Dim>& b,
                       double enough = std::numeric_limits<double>::infinity());

}  // namespace talus
