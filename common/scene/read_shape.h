#pragma once
// Shapes by kind. A new kind is one function in read_shape.cc and its line in the list there.

#include <optional>
#include <string>
#include <vector>

#include "common/scene/table_reader.h"
#include "common/world/world_description.h"

namespace talus {

/// The names that `kind` may have.
template <int Dim>
std::vector<std::string> shape_kinds();

/// The table's `kind`, which must be one of `kinds`; noted and empty if it is none.
std::string read_kind(TableReader& table, const std::vector<std::string>& kinds);

/// The shape that the keys of `kind` describe; nothing if one of them is wrong or the engines cannot hold such a shape,
/// which is noted at the key or at the table.
template <int Dim>
std::optional<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                     const Material& material);

/// `[shape.NAME]`.
template <int Dim>
std::optional<Shape<Dim>> read_body_shape(TableReader& table, const std::string& name);

/// Friction and restitution.
void read_surface(TableReader& table, Material& material);

/// Dim lengths that must be given.
template <int Dim>
Vec<Dim> read_size(TableReader& table, std::string_view key);

/// `angle_deg`, in 3D about `axis`; nothing if neither is given.
template <int Dim>
std::optional<Rotation<Dim>> read_rotation(TableReader& table);

}  // namespace talus
