#include "common/shape/shape.h"

#include <fmt/format.h>

#include "common/math/require.h"
#include "common/shape/check_piece.h"
#include "common/shape/moments.h"

namespace talus {
namespace {

template <int Dim>
void move(BoxPiece<Dim>& box, const Vec<Dim>& by) {
  box.pose.position += by;
}
template <int Dim>
void move(BallPiece<Dim>& ball, const Vec<Dim>& by) {
  ball.centre += by;
}
template <int Dim>
void move(CapsulePiece<Dim>& capsule, const Vec<Dim>& by) {
  capsule.a += by;
  capsule.b += by;
}
template <int Dim>
void move(HullPiece<Dim>& hull, const Vec<Dim>& by) {
  for (Vec<Dim>& corner : hull.corners) {
    corner += by;
  }
}

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
void extend(Box<Dim>& bounds, const BoxPiece<Dim>& box, const Vec<Dim>& position, const Matrix<Dim>& turn) {
  const Matrix<Dim> axes = turn * box.pose.rotation.toRotationMatrix();
  const Vec<Dim> reach = axes.cwiseAbs() * box.half;
  const Vec<Dim> centre = position + turn * box.pose.position;
  bounds.extend(Box<Dim>(centre - reach, centre + reach));
}
template <int Dim>
void extend(Box<Dim>& bounds, const BallPiece<Dim>& ball, const Vec<Dim>& position, const Matrix<Dim>& turn) {
  const Vec<Dim> reach = Vec<Dim>::Constant(ball.radius);
  const Vec<Dim> centre = position + turn * ball.centre;
  bounds.extend(Box<Dim>(centre - reach, centre + reach));
}
template <int Dim>
void extend(Box<Dim>& bounds, const CapsulePiece<Dim>& capsule, const Vec<Dim>& position, const Matrix<Dim>& turn) {
  extend(bounds, BallPiece<Dim>{capsule.a, capsule.radius}, position, turn);
  extend(bounds, BallPiece<Dim>{capsule.b, capsule.radius}, position, turn);
}
template <int Dim>
void extend(Box<Dim>& bounds, const HullPiece<Dim>& hull, const Vec<Dim>& position, const Matrix<Dim>& turn) {
  for (const Vec<Dim>& corner : hull.corners) {
    bounds.extend(position + turn * corner);
  }
}

}  // namespace

template <int Dim>
MassProperties<Dim> mass_properties(const Piece<Dim>& piece) {
  check_piece(piece, "piece");
  const Moments<Dim> integrals = moments(piece);
  return {integrals.volume, integrals.centre, integrals.inertia()};
}

template <int Dim>
Shape<Dim> make_shape(std::string name, std::vector<Piece<Dim>> pieces, const Material& material) {
  Moments<Dim> whole;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    check_piece(pieces[i], fmt::format("shape '{}': pieces[{}]", name, i));
    whole += moments(pieces[i]);
  }
  return make_shape<Dim>(std::move(name), std::move(pieces), material, {whole.volume, whole.centre, whole.inertia()});
}

template <int Dim>
Shape<Dim> make_shape(std::string name, std::vector<Piece<Dim>> pieces, const Material& material,
                      const MassProperties<Dim>& masses) {
  require(!pieces.empty(), "shape '" + name + "': pieces.size", 0.0, "must be one piece or more");
  check_material(material, "shape '" + name + "': material");
  require(std::isfinite(masses.volume) && masses.volume > 0.0, "shape '" + name + "': volume", masses.volume,
          "must be finite and above 0");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    check_piece(pieces[i], fmt::format("shape '{}': pieces[{}]", name, i));
    std::visit([&](auto& kind) { move<Dim>(kind, -masses.centre); }, pieces[i]);
  }
  Shape<Dim> shape;
  shape.name = std::move(name);
  shape.pieces = std::move(pieces);
  shape.material = material;
  shape.reference = -masses.centre;
  shape.volume = masses.volume;
  shape.mass = material.density * masses.volume;
  shape.inertia = material.density * masses.inertia;
  shape.bounds = bounds_at(shape, Pose<Dim>{});
  shape.bounding_volume = shape.bounds.volume();
  shape.extent = shape.bounds.diagonal().norm();
  return shape;
}

template <int Dim>
Box<Dim> bounds_at(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  const Matrix<Dim> turn = pose.rotation.toRotationMatrix();
  Box<Dim> bounds;
  for (const Piece<Dim>& piece : shape.pieces) {
    std::visit([&](const auto& kind) { extend<Dim>(bounds, kind, pose.position, turn); }, piece);
  }
  return bounds;
}

template MassProperties<2> mass_properties(const Piece<2>&);
template MassProperties<3> mass_properties(const Piece<3>&);
template Shape<2> make_shape(std::string, std::vector<Piece<2>>, const Material&);
template Shape<2> make_shape(std::string, std::vector<Piece<2>>, const Material&, const MassProperties<2>&);
template Shape<3> make_shape(std::string, std::vector<Piece<3>>, const Material&);
template Shape<3> make_shape(std::string, std::vector<Piece<3>>, const Material&, const MassProperties<3>&);
template Box<2> bounds_at(const Shape<2>&, const Pose<2>&);
template Box<3> bounds_at(const Shape<3>&, const Pose<3>&);

}  // namespace talus
