#include "common/measure/convex_distance.h"

#include <algorithm>
#include <limits>

#include "common/measure/feature_distance.h"

namespace talus {
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
  for (const auto& [a0, a1] : a.edges) {
    for (const auto& [b0, b1] : b.edges) {
      nearest = std::min(nearest, segment_distance<Dim>(a.corners[a0], a.corners[a1], b.corners[b0], b.corners[b1]));
    }
  }
  return nearest;
}

double corners_distance(const ConvexPiece<3>& corners, const ConvexPiece<3>& faces) {
  double nearest = infinity;
  for (const Vec3& corner : corners.corners) {
    for (const auto& [i, j, k] : faces.triangles) {
      nearest = std::min(nearest, triangle_distance(corner, faces.corners[i], faces.corners[j], faces.corners[k]));
    }
  }
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
