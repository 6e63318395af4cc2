#pragma once
// A body's shape: convex pieces that do not overlap, in axes whose origin is the centre of mass.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/vector.h"
#include "common/shape/piece.h"

namespace talus {

/// What a surface and the matter behind it do. Friction and restitution are combined values: two bodies of this
/// material meet with just these. Two materials meet with the geometric mean of theirs, in every engine. surface_fields
/// and body_material_fields have the unit, range and effect of each.
struct Material {
  double density = 1000.0;
  double friction = 0.5;
  double restitution = 0.0;
  double rolling_friction = 0.0;
};

/// Throws on a value outside its range.
void check_material(const Material& material, const std::string& field);

/// Inertia about the centre of mass [kg m^2]: one number in 2D (about y), a symmetric matrix in 3D.
template <int Dim>
using Inertia = Eigen::Matrix<double, Dim == 2 ? 1 : 3, Dim == 2 ? 1 : 3>;

/// A rigid body's shape with all that follows from it. Made by make_shape(); origin = centre of mass.
template <int Dim>
struct Shape {
  std::string name;
  std::vector<Piece<Dim>> pieces;  // origin at the centre of mass
  Material material;
  Vec<Dim> reference = Vec<Dim>::Zero();  // where the origin of the axes it was described in lies now [m]
  double volume = 0.0;                    // [m^3], in 2D the area [m^2]
  double mass = 0.0;                      // [kg]
  Inertia<Dim> inertia = Inertia<Dim>::Zero();
  Box<Dim> bounds;               // in its own axes, unturned [m]
  double bounding_volume = 0.0;  // v_obj of section 3.1: volume of `bounds` [m^3], in 2D [m^2]
  double extent = 0.0;           // D of section 3.1: diagonal of `bounds` [m]
  double filling = 1.0;          // volume of the pieces' union over `volume`; not 1 where pieces stand in for a mesh
  std::string colour;            // in pictures, "#rrggbb"; empty: one of the picture's own, by the shape's number
};

/// Between the name of a shape and the number of its variant (`rock#2`), and the factor of its size (`rock#2*1.5`): no
/// TOML key has them without quotes.
inline constexpr std::string_view variant_mark = "#";
inline constexpr std::string_view size_mark = "*";
/// A shape's name without these.
inline std::string base_name(const std::string& name) {
  return name.substr(0, std::min(name.find(variant_mark), name.find(size_mark)));
}

/// Volume, centre of mass and inertia (about that centre) of unit density.
template <int Dim>
struct MassProperties {
  double volume = 0.0;
  Vec<Dim> centre = Vec<Dim>::Zero();
  Inertia<Dim> inertia = Inertia<Dim>::Zero();
};

/// Exact for every kind of piece. Throws std::invalid_argument on a piece without volume or with a non-finite value.
template <int Dim>
MassProperties<Dim> mass_properties(const Piece<Dim>& piece);

/// The shape made of `pieces`, given in any axes: moves the origin to the centre of mass and fills in all that follows.
/// Pieces must not overlap (what overlaps would count twice). Throws std::invalid_argument with field, value and rule.
template <int Dim>
Shape<Dim> make_shape(std::string name, std::vector<Piece<Dim>> pieces, const Material& material);

/// The same for pieces that stand in for the true body and may overlap, as the convex parts of a mesh do. `masses` are
/// the body's own, of unit density, in the axes of the pieces. Throws also on a volume that is not positive.
template <int Dim>
Shape<Dim> make_shape(std::string name, std::vector<Piece<Dim>> pieces, const Material& material,
                      const MassProperties<Dim>& masses);

/// A shape within a compound.
template <int Dim>
struct CompoundPart {
  Shape<Dim> shape;
  Pose<Dim> pose;  // of its centre of mass, in the axes of the compound
};

/// The shapes joined into one rigid body. Mass, centre and inertia are the sums of those of the parts, each of its own
/// density; where parts overlap both count. `surface`: friction, restitution and rolling friction of the whole; its
/// density means nothing. Throws as make_shape().
template <int Dim>
Shape<Dim> make_compound(std::string name, const std::vector<CompoundPart<Dim>>& parts, const Material& surface);

/// The same shape, `factor` times as large, of the same material.
template <int Dim>
Shape<Dim> scaled(const Shape<Dim>& shape, double factor, std::string name);

/// Torque by which a contact with what is no body resists turning, over the normal force [m].
template <int Dim>
double rolling_arm(const Shape<Dim>& shape);

/// The smallest axis-aligned box around a shape at a pose [m].
template <int Dim>
Box<Dim> bounds_at(const Shape<Dim>& shape, const Pose<Dim>& pose);

/// Radius [m] of the smallest sphere about the centre of mass that holds the shape however it is turned.
template <int Dim>
double bounding_radius(const Shape<Dim>& shape);

/// Least width of the pieces that are at least half as wide as the widest piece [m]. A thin piece between wider
/// ones does not make the body thin.
template <int Dim>
double thickness(const Shape<Dim>& shape);
/// Least width of its thinnest piece [m].
template <int Dim>
double least_width(const Shape<Dim>& shape);

}  // namespace talus
