#include "common/shape/bounding_radius.h"

#include <algorithm>

namespace talus {
namespace {

template <int Dim>
double farthest(const BoxPiece<Dim>& box) {
  double distance = 0.0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    Vec<Dim> local = box.half;
    for (int axis = 0; axis < Dim; ++axis) {
      local[axis] *= (corner >> axis & 1) != 0 ? 1.0 : -1.0;
    }
    distance = std::max(distance, (box.pose * local).norm());
  }
  return distance;
}

template <int Dim>
double farthest(const BallPiece<Dim>& ball) {
  return ball.centre.norm() + ball.radius;
}

template <int Dim>
double farthest(const CapsulePiece<Dim>& capsule) {
  return std::max(capsule.a.norm(), capsule.b.norm()) + capsule.radius;
}

template <int Dim>
double farthest(const HullPiece<Dim>& hull) {
  double distance = 0.0;
  for (const Vec<Dim>& corner : hull.corners) {
    distance = std::max(distance, corner.norm());
  }
  return distance;
}

}  // namespace

template <int Dim>
double bounding_radius(const Shape<Dim>& shape) {
  double radius = 0.0;
  for (const Piece<Dim>& piece : shape.pieces) {
    radius = std::max(radius, std::visit([](const auto& kind) { return farthest<Dim>(kind); }, piece));
  }
  return radius;
}

template double bounding_radius(const Shape<2>&);
template double bounding_radius(const Shape<3>&);

}  // namespace talus
