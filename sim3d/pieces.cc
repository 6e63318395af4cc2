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

PlacedPiece make_ball(const Vec3& centre, double radius) {
  return {std::make_unique<btSphereShape>(static_cast<btScalar>(radius)), centre, Eigen::Quaterniond::Identity()};
}

PlacedPiece make_capsule(const Vec3& a, const Vec3& b, double radius) {
  const Vec3 axis = b - a;
  return {std::make_unique<btCapsuleShapeX>(static_cast<btScalar>(radius), static_cast<btScalar>(axis.norm())),
          0.5 * (a + b), Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), axis)};
}

PlacedPiece make(const HullPiece<3>& hull) {
  if (hull.corners.size() == 1) return make_ball(hull.corners[0], hull.radius);
  if (hull.corners.size() == 2) return make_capsule(hull.corners[0], hull.corners[1], hull.radius);
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

Piece<3> lift(const HullPiece<2>& flat, double half_depth) {
  HullPiece<3> hull{{}, flat.radius};
  for (const Vec2& corner : flat.corners) {
    if (flat.round()) {
      hull.corners.push_back(lift(corner));
      continue;
    }
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
