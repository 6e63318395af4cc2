#include "sim3d/body_template.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/shape/piece.h"
#include "sim3d/conversions.h"
#include "sim3d/pieces.h"

namespace talus::bullet {
namespace {

// The turn from the principal axes to the shape's own; none where the inertia is diagonal already.
Eigen::Quaterniond principal_frame(const Eigen::Matrix3d& inertia) {
  const Eigen::Matrix3d diagonal = inertia.diagonal().asDiagonal();
  if ((inertia - diagonal).cwiseAbs().maxCoeff() <= 1e-9 * inertia.trace()) {
    return Eigen::Quaterniond::Identity();
  }
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
    if (pieces.back().position.norm() < 1e-9 * shape.extent) {
      pieces.back().position.setZero();
    }
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
  if (shape.pieces.size() == 1 && !is_polyhedron<Dim>(shape.pieces[0])) {
    return make_piece(spatial(shape, shape.pieces[0])).rotation;
  }
  if constexpr (Dim == 3) {
    return principal_frame(shape.inertia);
  } else {
    return Eigen::Quaterniond::Identity();
  }
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
  made.friction = static_cast<btScalar>(std::sqrt(shape.material.friction));
  made.restitution = static_cast<btScalar>(std::sqrt(shape.material.restitution));
  double width = smallest_width(shape.pieces[0]);
  for (const Piece<Dim>& piece : shape.pieces) {
    width = std::min(width, smallest_width(piece));
  }
  made.inner_radius = static_cast<btScalar>(0.5 * width);
  made.sweep_from = made.inner_radius;
  return made;
}

template BodyTemplate make_body_template(const Shape<2>&, double);
template BodyTemplate make_body_template(const Shape<3>&, double);

}  // namespace talus::bullet
