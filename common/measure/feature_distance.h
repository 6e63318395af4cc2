#pragma once
// Distances of points, segments and triangles.

#include "common/math/vector.h"

namespace talus {

/// Between the segments p1-q1 and p2-q2, either of which may be a point [m].
template <int Dim>
double segment_distance(const Vec<Dim>& p1, const Vec<Dim>& q1, const Vec<Dim>& p2, const Vec<Dim>& q2);

/// From a point to the triangle a, b, c [m].
double triangle_distance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace talus
