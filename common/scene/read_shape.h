#pragma once
// Shapes in scene files: the kinds, and the keys that obstacles and sources share with them.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/table_reader.h"
#include "common/world/world_description.h"

namespace talus {

/// A kind of shape that is made of convex pieces.
template <int Dim>
struct ShapeKind {
  std::string_view name;
  /// Reads the keys of the kind. No pieces where one of them is wrong; throws InvalidValue where they make no shape
  /// together.
  std::function<std::vector<Piece<Dim>>(TableReader&)> read;
};

/// All such kinds. A new one is a struct of parameters with its fields and a function in common/shape/catalogue.h, and
/// a line in read_shape.cc.
template <int Dim>
std::vector<ShapeKind<Dim>> shape_kinds();

/// The names that `kind` may have: of the kinds above and "mesh".
template <int Dim>
std::vector<std::string> names_of_shape_kinds();

/// The table's `kind`, one of `kinds`; empty, with an error, if it is none.
std::string read_kind(TableReader& table, const std::vector<std::string>& kinds);

/// A rotation as scene files give it: an angle [rad], in 3D about an axis.
template <int Dim>
struct Turn {
  double angle = 0.0;
  Vec3 axis = Vec3::UnitZ();  // unit; means nothing in 2D

  /// By another angle about the same axis.
  Rotation<Dim> rotation(double by) const {
    if constexpr (Dim == 2)
      return Rotation<2>(by);
    else
      return Rotation<3>(Eigen::AngleAxisd(by, axis));
  }
  Rotation<Dim> rotation() const { return rotation(angle); }
};

/// `angle_deg`, in 3D about `axis`; nothing if neither is given.
template <int Dim>
std::optional<Turn<Dim>> read_turn(TableReader& table);
template <int Dim>
std::optional<Rotation<Dim>> read_rotation(TableReader& table);

/// The pose of a body's centre of mass that brings the origin of the axes in which its shape was described to `pose`.
template <int Dim>
Pose<Dim> pose_of_centre(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  return {pose * Vec<Dim>(-shape.reference), pose.rotation};
}

/// The shape that the keys of `kind` describe; nothing, with an error at the key or at the table, if one of them is
/// wrong or the engines cannot simulate such a shape.
template <int Dim>
std::optional<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                     const Material& material);

/// `[shape.NAME]`.
template <int Dim>
std::optional<Shape<Dim>> read_body_shape(TableReader& table, const std::string& name);

}  // namespace talus
