#include "common/shape/convex_distance.h"

#include <algorithm>
#include <limits>

namespace talus {

/// Ericson, Real-Time Collision Detection (2005), section 5.1.9.
template <int Dim>
double segment_distance(const Vec<Dim>& p1, const Vec<Dim>& q1, const Vec<Dim>& p2, const Vec<Dim>& q2) {
  const Vec<Dim> d1 = q1 - p1;
  const Vec<Dim> d2 = q2 - p2;
  const Vec<Dim> r = p1 - p2;
  const double a = d1.squaredNorm();
  const double b = d1.dot(d2);
  const double c = d1.dot(r);
  const double e = d2.squaredNorm();
  const double f = d2.dot(r);
  double s = 0.0;
  double t = 0.0;
  if (a <= 0.0) {
    t = e > 0.0 ? std::clamp(f / e, 0.0, 1.0) : 0.0;
  } else if (e <= 0.0) {
    s = std::clamp(-c / a, 0.0, 1.0);
  } else {
    const double skew = a * e - b * b;  // 0 for parallel segments, of which any s will do
    s = skew > 1e-14 * a * e ? std::clamp((b * f - c * e) / skew, 0.0, 1.0) : 0.0;
    t = (b * s + f) / e;
    if (t < 0.0 || t > 1.0) {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
  }
  return (r + s * d1 - t * d2).norm();
}

/// Ericson, section 5.1.5: the point lies over a corner, an edge or the face.
double triangle_distance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(point - a);
  const double d2 = ac.dot(point - a);
  if (d1 <= 0.0 && d2 <= 0.0) return (point - a).norm();
  const double d3 = ab.dot(point - b);
  const double d4 = ac.dot(point - b);
  if (d3 >= 0.0 && d4 <= d3) return (point - b).norm();
  const double over_ab = d1 * d4 - d3 * d2;
  if (over_ab <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return (point - a - d1 / (d1 - d3) * ab).norm();
  const double d5 = ab.dot(point - c);
  const double d6 = ac.dot(point - c);
  if (d6 >= 0.0 && d5 <= d6) return (point - c).norm();
  const double over_ac = d5 * d2 - d1 * d6;
  if (over_ac <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return (point - a - d2 / (d2 - d6) * ac).norm();
  const double over_bc = d3 * d6 - d5 * d4;
  if (over_bc <= 0.0 && d4 >= d3 && d5 >= d6) return (point - b - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)).norm();
  const double sum = over_ab + over_ac + over_bc;
  return (point - a - over_ac / sum * ab - over_ab / sum * ac).norm();
}

template double segment_distance<2>(const Vec<2>&, const Vec<2>&, const Vec<2>&, const Vec<2>&);
template double segment_distance<3>(const Vec<3>&, const Vec<3>&, const Vec<3>&, const Vec<3>&);

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Gap between the shadows of two sets of corners on a line along unit `axis`; negative where they overlap.
template <int Dim>
double gap(const ConvexPiece<Dim>& a, const ConvexPiece<Dim>& b, const Vec<Dim>& axis) {
  const auto shadow = [&](const ConvexPiece<Dim>& piece) {
    double low = infinity;
    double high = -infinity;
    for (const Vec<Dim>& corner : piece.corners) {
      const double at = corner.dot(axis);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    return std::pair(low, high);
  };
  const auto [low_a, high_a] = shadow(a);
  const auto [low_b, high_b] = shadow(b);
  return std::max(low_b - high_a, low_a - high_b);
}

/// The widest gap along any axis: face normals and products of edges. Overlapping polytopes are parted most easily
/// along one of these, so there it is minus the depth; if it is positive they are apart, at least so far. The search
/// may end with the first gap of `enough`.
template <int Dim>
double widest_gap(const ConvexPiece<Dim>& a, const ConvexPiece<Dim>& b, double enough) {
  double widest = -infinity;
  for (const Vec<Dim>& axis : a.normals) widest = std::max(widest, gap(a, b, axis));
  for (const Vec<Dim>& axis : b.normals) widest = std::max(widest, gap(a, b, axis));
  if (widest >= enough) return widest;
  if constexpr (Dim == 3) {
    for (const Vec3& along_a : a.directions) {
      for (const Vec3& along_b : b.directions) {
        const Vec3 axis = along_a.cross(along_b);
        const double sine = axis.norm();
        // Of parallel edges the faces' normals suffice: rounding would turn their product anywhere.
        if (sine > 1e-8) widest = std::max(widest, gap<3>(a, b, axis / sine));
      }
    }
  }
  return widest;
}

template <int Dim>
double edges_distance(const ConvexPiece<Dim>& a, const ConvexPiece<Dim>& b) {
  double nearest = infinity;
  for (const auto& [a0, a1] : a.edges)
    for (const auto& [b0, b1] : b.edges)
      nearest = std::min(nearest, segment_distance<Dim>(a.corners[a0], a.corners[a1], b.corners[b0], b.corners[b1]));
  return nearest;
}

double corners_distance(const ConvexPiece<3>& corners, const ConvexPiece<3>& faces) {
  double nearest = infinity;
  for (const Vec3& corner : corners.corners)
    for (const auto& [i, j, k] : faces.triangles)
      nearest = std::min(nearest, triangle_distance(corner, faces.corners[i], faces.corners[j], faces.corners[k]));
  return nearest;
}

}  // namespace

template <int Dim>
double signed_distance(const ConvexPiece<Dim>& a, const ConvexPiece<Dim>& b, double enough) {
  const double margin = a.radius + b.radius;
  const double widest = widest_gap(a, b, enough + margin);
  if (widest - margin >= enough) return widest - margin;
  // Without any axis, both are points, or segments along one line.
  if (widest < 0.0 && widest > -infinity) return widest - margin;
  double nearest = edges_distance(a, b);
  if constexpr (Dim == 3) nearest = std::min({nearest, corners_distance(a, b), corners_distance(b, a)});
  return nearest - margin;
}

template double signed_distance(const ConvexPiece<2>&, const ConvexPiece<2>&, double);
template double signed_distance(const ConvexPiece<3>&, const ConvexPiece<3>&, double);

}  // namespace talus
