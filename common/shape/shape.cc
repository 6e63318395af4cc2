#include "common/shape/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/require.h"
#include "common/shape/moments.h"
#include "common/shape/shape_fields.h"

namespace talus {

void check_material(const Material& material, const std::string& field) {
  check_fields(material, body_material_fields, field);
  check_fields(material, surface_fields, field);
}

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
    translate<Dim>(pieces[i], -masses.centre);
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
Shape<Dim> scaled(const Shape<Dim>& shape, double factor, std::string name) {
  std::vector<Piece<Dim>> pieces = shape.pieces;
  for (Piece<Dim>& piece : pieces) scale(piece, factor);
  const double volume = std::pow(factor, Dim) * shape.volume;
  const MassProperties<Dim> masses{volume, Vec<Dim>::Zero(),
                                   Inertia<Dim>(std::pow(factor, Dim + 2) / shape.material.density * shape.inertia)};
  Shape<Dim> larger = make_shape<Dim>(std::move(name), std::move(pieces), shape.material, masses);
  larger.reference = factor * shape.reference;
  larger.filling = shape.filling;
  larger.colour = shape.colour;
  return larger;
}

namespace {

/// Inertia about a point `from` [m] away from the centre of mass.
template <int Dim>
Inertia<Dim> inertia_about(const Inertia<Dim>& inertia, double mass, const Vec<Dim>& from) {
  if constexpr (Dim == 2)
    return inertia + Inertia<2>(mass * from.squaredNorm());
  else
    return inertia + mass * (from.squaredNorm() * Inertia<3>::Identity() - from * from.transpose());
}

template <int Dim>
Inertia<Dim> turned(const Inertia<Dim>& inertia, const Rotation<Dim>& rotation) {
  if constexpr (Dim == 2)
    return inertia;
  else
    return rotation.toRotationMatrix() * inertia * rotation.toRotationMatrix().transpose();
}

}  // namespace

template <int Dim>
Shape<Dim> make_compound(std::string name, const std::vector<CompoundPart<Dim>>& parts, const Material& surface) {
  std::vector<Piece<Dim>> pieces;
  double mass = 0.0;
  double filled = 0.0;
  MassProperties<Dim> whole;
  for (const CompoundPart<Dim>& part : parts) {
    for (const Piece<Dim>& piece : part.shape.pieces) pieces.push_back(placed(piece, part.pose));
    mass += part.shape.mass;
    whole.volume += part.shape.volume;
    filled += part.shape.filling * part.shape.volume;
    whole.centre += part.shape.mass * part.pose.position;
  }
  whole.centre /= mass;
  for (const CompoundPart<Dim>& part : parts)
    whole.inertia += inertia_about<Dim>(turned<Dim>(part.shape.inertia, part.pose.rotation), part.shape.mass,
                                        part.pose.position - whole.centre);
  Material material = surface;
  material.density = mass / whole.volume;
  whole.inertia /= material.density;
  Shape<Dim> shape = make_shape<Dim>(std::move(name), std::move(pieces), material, whole);
  shape.filling = filled / whole.volume;
  return shape;
}

template <int Dim>
double rolling_arm(const Shape<Dim>& shape) {
  if (shape.material.rolling_friction == 0.0) return 0.0;
  return 0.5 * least_width(shape) * shape.material.rolling_friction;
}

template <int Dim>
Box<Dim> bounds_at(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  const Eigen::Matrix<double, Dim, Dim> turn = pose.rotation.toRotationMatrix();
  Box<Dim> bounds;
  for (const Piece<Dim>& piece : shape.pieces) bounds.extend(bounds_of<Dim>(piece, turn, pose.position));
  return bounds;
}

template <int Dim>
double bounding_radius(const Shape<Dim>& shape) {
  double radius = 0.0;
  for (const Piece<Dim>& piece : shape.pieces) radius = std::max(radius, reach_of(piece));
  return radius;
}

template <int Dim>
double thickness(const Shape<Dim>& shape) {
  std::vector<double> widths;
  for (const Piece<Dim>& piece : shape.pieces) widths.push_back(smallest_width(piece));
  const double widest = std::ranges::max(widths);
  double least = widest;
  for (const double width : widths)
    if (width >= 0.5 * widest) least = std::min(least, width);
  return least;
}

template <int Dim>
double least_width(const Shape<Dim>& shape) {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece<Dim>& piece : shape.pieces) least = std::min(least, smallest_width(piece));
  return least;
}

template MassProperties<2> mass_properties(const Piece<2>&);
template MassProperties<3> mass_properties(const Piece<3>&);
template Shape<2> make_shape(std::string, std::vector<Piece<2>>, const Material&);
template Shape<2> make_shape(std::string, std::vector<Piece<2>>, const Material&, const MassProperties<2>&);
template Shape<3> make_shape(std::string, std::vector<Piece<3>>, const Material&);
template Shape<3> make_shape(std::string, std::vector<Piece<3>>, const Material&, const MassProperties<3>&);
template Shape<2> make_compound(std::string, const std::vector<CompoundPart<2>>&, const Material&);
template Shape<3> make_compound(std::string, const std::vector<CompoundPart<3>>&, const Material&);
template Shape<2> scaled(const Shape<2>&, double, std::string);
template Shape<3> scaled(const Shape<3>&, double, std::string);
template double rolling_arm(const Shape<2>&);
template double rolling_arm(const Shape<3>&);
template Box<2> bounds_at(const Shape<2>&, const Pose<2>&);
template Box<3> bounds_at(const Shape<3>&, const Pose<3>&);
template double bounding_radius(const Shape<2>&);
template double bounding_radius(const Shape<3>&);
template double thickness(const Shape<2>&);
template double thickness(const Shape<3>&);
template double least_width(const Shape<2>&);
template double least_width(const Shape<3>&);

}  // namespace talus
