#pragma once
// One convex piece as a Bullet shape.

#include <btBulletCollisionCommon.h>

#include <memory>

#include "common/shape/shape.h"

namespace talus::bullet {

/// A piece and where it sits in the axes of its shape.
struct PlacedPiece {
  std::unique_ptr<btCollisionShape> shape;
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

PlacedPiece make_piece(const Piece<3>& piece);

/// The piece turned about the origin.
Piece<3> turned(const Piece<3>& piece, const Eigen::Quaterniond& by);

/// A 2D piece as a 3D one around the x-z plane: boxes and polygons reach `half_depth` to both sides along y, discs
/// become balls and capsules stay capsules, which in the plane are the same.
Piece<3> extrude(const Piece<2>& piece, double half_depth);

}  // namespace talus::bullet
