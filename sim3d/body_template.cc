#include "sim3d/body_template.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/math/angle.h"
#include "common/shape/piece.h"
#include "sim3d/conversions.h"

namespace talus::bullet {
namespace {

// Masses that Bullet holds as they are [kg]. Its solver leaves out each contact between bodies whose inverse mass has
// a norm below SIMD_EPSILON (btVector3::fuzzyZero): from 1.45e7 kg in 3D, from 1.19e7 kg in the plane. Far below
// 1e-4 kg, products of inverse masses leave single precision's range.
constexpr double least_plain_mass = 0.01;  // of the heaviest shape; the lightest weighs a hundredth or more
constexpr double most_plain_mass = 1e6;

/// A piece and where it sits in the axes of its shape.
struct PlacedPiece {
  std::unique_ptr<btCollisionShape> shape;
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

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
          0.5 * (a + b), turn_to(axis)};
}

PlacedPiece make(const HullPiece<3>& hull) {
  if (hull.corners.size() == 1) return make_ball(hull.corners[0], hull.radius);
  if (hull.corners.size() == 2) return make_capsule(hull.corners[0], hull.corners[1], hull.radius);
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vec3& corner : hull.corners) shape->addPoint(to_bullet(corner), false);
  shape->recalcLocalAabb();
  shape->setMargin(static_cast<btScalar>(hull_margin));
  return {with_faces(std::move(shape)), Vec3::Zero(), Eigen::Quaterniond::Identity()};
}

Piece<3> turn(const BoxPiece<3>& box, const Eigen::Quaterniond& by) {
  return BoxPiece<3>{{by * box.pose.position, by * box.pose.rotation}, box.half};
}

Piece<3> turn(HullPiece<3> hull, const Eigen::Quaterniond& by) {
  for (Vec3& corner : hull.corners) corner = by * corner;
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

PlacedPiece make_piece(const Piece<3>& piece) {
  return std::visit([](const auto& p) { return make(p); }, piece);
}

/// The piece turned about the origin.
Piece<3> turned(const Piece<3>& piece, const Eigen::Quaterniond& by) {
  return std::visit([&by](const auto& p) { return turn(p, by); }, piece);
}

/// A 2D piece as a 3D one around the x-z plane: boxes and polygons reach `half_depth` to both sides along y, discs
/// become balls and capsules stay capsules, which in the plane are the same.
Piece<3> extrude(const Piece<2>& piece, double half_depth) {
  return std::visit([half_depth](const auto& p) { return lift(p, half_depth); }, piece);
}

}  // namespace

template <int Dim>
double mass_scale(std::span<const Shape<Dim>> shapes) {
  constexpr int scaled_exponent = 10;  // the heaviest shape weighs 1024 to 2048 units
  double heaviest = 0.0;
  for (const Shape<Dim>& shape : shapes) heaviest = std::max(heaviest, shape.mass);
  if (heaviest == 0.0 || (heaviest >= least_plain_mass && heaviest <= most_plain_mass)) return 1.0;
  return std::ldexp(1.0, scaled_exponent - std::ilogb(heaviest));
}

template double mass_scale(std::span<const Shape<2>>);
template double mass_scale(std::span<const Shape<3>>);

namespace {

// The turn from the principal axes to the shape's own; none where the inertia is diagonal already.
Eigen::Quaterniond principal_frame(const Eigen::Matrix3d& inertia) {
  const Eigen::Matrix3d diagonal = inertia.diagonal().asDiagonal();
  if ((inertia - diagonal).cwiseAbs().maxCoeff() <= 1e-9 * inertia.trace()) return Eigen::Quaterniond::Identity();
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvectors();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return Eigen::Quaterniond(axes);
}

// A lone piece in the body's axes needs no compound around it.
void assemble(BodyTemplate& made, std::vector<PlacedPiece> pieces) {
  const PlacedPiece& first = pieces.front();
  if (pieces.size() == 1 && first.position.isZero(0.0) && first.rotation.isApprox(Eigen::Quaterniond::Identity())) {
    made.parts.push_back(std::move(pieces[0].shape));
  } else {
    auto compound = std::make_unique<btCompoundShape>(true, static_cast<int>(pieces.size()));
    for (PlacedPiece& piece : pieces) {
      compound->addChildShape(btTransform(to_bullet(piece.rotation), to_bullet(piece.position)), piece.shape.get());
      made.parts.push_back(std::move(piece.shape));
    }
    made.parts.push_back(std::move(compound));
  }
  made.whole = made.parts.back().get();
}

// As deep as the shape is long, so that two shapes never part along y.
Piece<3> spatial(const Shape<2>& shape, const Piece<2>& piece) { return extrude(piece, 0.5 * shape.extent); }
Piece<3> spatial(const Shape<3>&, const Piece<3>& piece) { return piece; }

// The pieces in the axes that Bullet keeps the body in. What lies at the origin but for rounding is put there.
template <int Dim>
std::vector<PlacedPiece> make_pieces(const Shape<Dim>& shape, const BodyTemplate& made) {
  std::vector<PlacedPiece> pieces;
  for (const Piece<Dim>& piece : shape.pieces) {
    pieces.push_back(make_piece(turned(spatial(shape, piece), made.frame_inverse)));
    if (pieces.back().position.norm() < 1e-9 * shape.extent) pieces.back().position.setZero();
  }
  return pieces;
}

void set_inertia(BodyTemplate& made, const Inertia<2>& inertia) {
  made.inertia = btVector3(1, 1, 1) * static_cast<btScalar>(inertia(0, 0));
  made.linear_factor = btVector3(1, 0, 1);
  made.angular_factor = btVector3(0, 1, 0);
}

void set_inertia(BodyTemplate& made, const Inertia<3>& inertia) {
  const Eigen::Matrix3d principal = made.frame_inverse * inertia * made.frame.toRotationMatrix();
  made.inertia = to_bullet(Vec3(principal.diagonal()));
}

template <int Dim>
bool is_polyhedron(const Piece<Dim>& piece) {
  const auto* hull = std::get_if<HullPiece<Dim>>(&piece);
  return hull != nullptr && !hull->round();
}

// The own axes of a lone box, ball or capsule are principal axes.
template <int Dim>
Eigen::Quaterniond choose_frame(const Shape<Dim>& shape) {
  if (shape.pieces.size() == 1 && !is_polyhedron<Dim>(shape.pieces[0]))
    return make_piece(spatial(shape, shape.pieces[0])).rotation;
  if constexpr (Dim == 3)
    return principal_frame(shape.inertia);
  else
    return Eigen::Quaterniond::Identity();
}

}  // namespace

template <int Dim>
BodyTemplate make_body_template(const Shape<Dim>& shape, double mass_scale) {
  BodyTemplate made;
  made.frame = choose_frame(shape);
  made.frame_inverse = made.frame.conjugate();
  assemble(made, make_pieces(shape, made));
  made.mass = static_cast<btScalar>(mass_scale * shape.mass);
  set_inertia(made, Inertia<Dim>(mass_scale * shape.inertia));
  made.surface.friction = static_cast<btScalar>(pair_friction(shape.material.friction, 1.0));  // Bullet multiplies both
  made.surface.restitution = static_cast<btScalar>(std::sqrt(shape.material.restitution));
  made.inner_radius = static_cast<btScalar>(0.5 * least_width(shape));
  made.sweep_from = made.inner_radius;
  return made;
}

template BodyTemplate make_body_template(const Shape<2>&, double);
template BodyTemplate make_body_template(const Shape<3>&, double);

}  // namespace talus::bullet
