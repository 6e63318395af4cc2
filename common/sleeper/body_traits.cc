#include "common/sleeper/body_traits.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "common/math/require.h"
#include "common/math/require_finite.h"

namespace talus {
namespace {

template <int Dim>
Box<Dim> centred_box(const Vec<Dim>& size) {
  return {-0.5 * size, 0.5 * size};
}

template <int Dim>
void check_traits(const BodyTraits<Dim>& traits, bool kinematic) {
  require_finite(traits.bounds.min(), "bounds.low");
  require_finite(traits.bounds.max(), "bounds.high");
  const Vec<Dim> size = traits.bounds.max() - traits.bounds.min();
  require(size.allFinite() && size.minCoeff() > 0.0, "bounds size", size.minCoeff(),
          "must be finite and above 0 on every axis");
  require(std::isfinite(traits.friction) && traits.friction >= 0.0, "friction", traits.friction,
          "must be finite and at least 0");
  for (std::size_t i = 0; i < traits.pieces.size(); ++i)
    check_piece<Dim>(traits.pieces[i], fmt::format("pieces[{}]", i));
  if (kinematic) return;
  for (int axis = 0; axis < Dim; ++axis) {
    require(traits.bounds.min()[axis] <= 0.0, fmt::format("bounds.low[{}]", axis), traits.bounds.min()[axis],
            "must be at most 0, since the centre of mass is the origin");
    require(traits.bounds.max()[axis] >= 0.0, fmt::format("bounds.high[{}]", axis), traits.bounds.max()[axis],
            "must be at least 0, since the centre of mass is the origin");
  }
  require(std::isfinite(traits.mass) && traits.mass > 0.0, "mass", traits.mass, "must be finite and above 0");
  const Inertia<Dim>& inertia = traits.inertia;
  require_finite(inertia, "inertia");
  require(inertia.isApprox(inertia.transpose(), 1e-5) && inertia.llt().info() == Eigen::Success,
          "inertia's determinant", inertia.determinant(), "must be that of a symmetric, positive definite matrix");
}

}  // namespace

template <int Dim>
void add_piece(const Piece<Dim>& piece, std::vector<Piece<Dim>>& pieces) {
  try {
    check_piece<Dim>(piece, "piece");
  } catch (const std::invalid_argument&) {
    return;
  }
  pieces.push_back(piece);
}

template <int Dim>
BodyTraits<Dim> box_traits(double mass, const Vec<Dim>& size) {
  BodyTraits<Dim> traits{.mass = mass, .bounds = centred_box<Dim>(size)};
  const double squares = size.squaredNorm();
  if constexpr (Dim == 2)
    traits.inertia(0, 0) = mass / 12.0 * squares;
  else
    traits.inertia.diagonal() = mass / 12.0 * (Vec3::Constant(squares) - size.cwiseAbs2());
  return traits;
}

template <int Dim>
BodyTraits<Dim> ball_traits(double mass, double radius) {
  const double share = Dim == 2 ? 0.5 : 0.4;
  return {.mass = mass,
          .inertia = share * mass * radius * radius * Inertia<Dim>::Identity(),
          .bounds = centred_box<Dim>(Vec<Dim>::Constant(2.0 * radius)),
          .pieces = {HullPiece<Dim>{.corners = {Vec<Dim>::Zero()}, .radius = radius}}};
}

template <int Dim>
BodyTraits<Dim> traits_of(const Shape<Dim>& shape) {
  return {.mass = shape.mass,
          .inertia = shape.inertia,
          .bounds = shape.bounds,
          .friction = shape.material.friction,
          .pieces = shape.pieces};
}

template <int Dim>
Shape<Dim> shape_with(const BodyTraits<Dim>& traits, bool kinematic) {
  check_traits(traits, kinematic);
  const Vec<Dim> size = traits.bounds.max() - traits.bounds.min();
  Shape<Dim> shape;
  shape.pieces = traits.pieces;
  if (shape.pieces.empty())
    shape.pieces = {BoxPiece<Dim>{.pose = {.position = traits.bounds.center()}, .half = 0.5 * size}};
  shape.material.friction = traits.friction;
  shape.mass = traits.mass;
  shape.inertia = traits.inertia;
  shape.bounds = traits.bounds;
  shape.bounding_volume = size.prod();
  shape.volume = shape.bounding_volume;
  if (!kinematic) shape.material.density = shape.mass / shape.volume;
  shape.extent = size.norm();
  return shape;
}

template void add_piece<2>(const Piece<2>&, std::vector<Piece<2>>&);
template void add_piece<3>(const Piece<3>&, std::vector<Piece<3>>&);
template BodyTraits<2> box_traits<2>(double, const Vec<2>&);
template BodyTraits<3> box_traits<3>(double, const Vec<3>&);
template BodyTraits<2> ball_traits<2>(double, double);
template BodyTraits<3> ball_traits<3>(double, double);
template BodyTraits<2> traits_of<2>(const Shape<2>&);
template BodyTraits<3> traits_of<3>(const Shape<3>&);
template Shape<2> shape_with<2>(const BodyTraits<2>&, bool);
template Shape<3> shape_with<3>(const BodyTraits<3>&, bool);

}  // namespace talus
