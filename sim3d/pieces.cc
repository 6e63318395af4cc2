#include "sim3d/pieces.h"

#include "sim3d/body_template.h"
#include "sim3d/conversions.h"

namespace talus::bullet {
namespace {

Vec3 lift(const Vec2& v) { return {v.x(), 0.0, v.y()}; }

// Faces and edges let two polyhedra exchange all points of a contact at once instead of one a step.
std::unique_ptr<btCollisionShape> with_faces(std::unique_ptr<btPolyhedralConvexShape> shape) {
  shape->initializePolyhedralFeatures();
  return shape;
}

PlacedPiece make(const BoxPiece<3>& box) {
  return {with_faces(std::make_unique<btBoxShape>(to_bullet(box.half))), box.pose.position,
          box.pose.rotation.normalized()};
}

PlacedPiece make(const BallPiece<3>& ball) {
  return {std::make_unique<btSphereShape>(static_cast<btScalar>(ball.radius)), ball.centre,
          Eigen::Quaterniond::Identity()};
}

PlacedPiece make(const CapsulePiece<3>& capsule) {
  const Vec3 axis = capsule.b - capsule.a;
  return {std::make_unique<btCapsuleShapeX>(static_cast<btScalar>(capsule.radius), static_cast<btScalar>(axis.norm())),
          0.5 * (capsule.a + capsule.b), Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), axis)};
}

PlacedPiece make(const HullPiece<3>& hull) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vec3& corner : hull.corners) {
    shape->addPoint(to_bullet(corner), false);
  }
  shape->recalcLocalAabb();
  shape->setMargin(static_cast<btScalar>(hull_margin));
  return {with_faces(std::move(shape)), Vec3::Zero(), Eigen::Quaterniond::Identity()};
}

Piece<3> turn(const BoxPiece<3>& box, const Eigen::Quaterniond& by) {
  return BoxPiece<3>{{by * box.pose.position, by * box.pose.rotation}, box.half};
}

Piece<3> turn(const BallPiece<3>& ball, const Eigen::Quaterniond& by) {
  return BallPiece<3>{by * ball.centre, ball.radius};
}

Piece<3> turn(const CapsulePiece<3>& capsule, const Eigen::Quaterniond& by) {
  return CapsulePiece<3>{by * capsule.a, by * capsule.b, capsule.radius};
}

Piece<3> turn(HullPiece<3> hull, const Eigen::Quaterniond& by) {
  for (Vec3& corner : hull.corners) {
    corner = by * corner;
  }
  return hull;
}

Piece<3> lift(const BoxPiece<2>& box, double half_depth) {
  return BoxPiece<3>{{lift(box.pose.position), quaternion(box.pose.rotation)},
                     {box.half.x(), half_depth, box.half.y()}};
}

Piece<3> lift(const BallPiece<2>& ball, double) { return BallPiece<3>{lift(ball.centre), ball.radius}; }

Piece<3> lift(const CapsulePiece<2>& capsule, double) {
  return CapsulePiece<3>{lift(capsule.a), lift(capsule.b), capsule.radius};
}

Piece<3> lift(const HullPiece<2>& polygon, double half_depth) {
  HullPiece<3> hull;
  for (const Vec2& corner : polygon.corners) {
    hull.corners.push_back(lift(corner) + half_depth * Vec3::UnitY());
    hull.corners.push_back(lift(corner) - half_depth * Vec3::UnitY());
  }
  return hull;
}

}  // namespace

PlacedPiece make_piece(const Piece<3>& piece) {
  return std::visit([](const auto& p) { return make(p); }, piece);
}

Piece<3> turned(const Piece<3>& piece, const Eigen::Quaterniond& by) {
  return std::visit([&by](const auto& p) { return turn(p, by); }, piece);
}

Piece<3> extrude(const Piece<2>& piece, double half_depth) {
  return std::visit([half_depth](const auto& p) { return lift(p, half_depth); }, piece);
}

}  // namespace talus::bullet
