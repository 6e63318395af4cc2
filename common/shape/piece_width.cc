#include "common/shape/piece_width.h"

#include <algorithm>
#include <limits>

#include "common/shape/convex_hull.h"
#include "common/shape/polygon.h"

namespace talus {

namespace {

// Least over the edges of the largest distance of a corner from it.
double width(const std::vector<Vec2>& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& to = corners[(i + 1) % corners.size()];
    double largest = 0.0;
    for (const Vec2& corner : corners) {
      largest = std::max(largest, distance_from_line(corner, corners[i], to));
    }
    least = std::min(least, largest);
  }
  return least;
}

double width(const std::vector<Vec3>& corners) {
  const std::vector<std::vector<int>> faces = convex_hull_faces(corners);
  double least = faces.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const std::vector<int>& face : faces) {
    const Vec3& origin = corners[face[0]];
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      normal += (corners[face[i]] - origin).cross(corners[face[i + 1]] - origin);
    }
    normal.normalize();
    double largest = 0.0;
    for (const Vec3& corner : corners) {
      largest = std::max(largest, -normal.dot(corner - origin));
    }
    least = std::min(least, largest);
  }
  return least;
}

template <int Dim>
double width_of(const BoxPiece<Dim>& box) {
  return 2.0 * box.half.minCoeff();
}
template <int Dim>
double width_of(const BallPiece<Dim>& ball) {
  return 2.0 * ball.radius;
}
template <int Dim>
double width_of(const CapsulePiece<Dim>& capsule) {
  return 2.0 * capsule.radius;
}
template <int Dim>
double width_of(const HullPiece<Dim>& hull) {
  return width(hull.corners);
}

}  // namespace

template <int Dim>
double smallest_width(const Piece<Dim>& piece) {
  return std::visit([](const auto& kind) { return width_of(kind); }, piece);
}

template double smallest_width(const Piece<2>&);
template double smallest_width(const Piece<3>&);

}  // namespace talus
