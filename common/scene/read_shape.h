#pragma once
// Shapes by kind. A new kind of convex pieces is one function in read_pieces.cc and its line in the list there.

#include <optional>
#include <string>
#include <vector>

#include "common/scene/table_reader.h"
#include "common/world/world_description.h"

namespace talus {

/// The names that `kind` may have.
template <int Dim>
std::vector<std::string> shape_kinds();

/// The shape that the keys of `kind` describe; nothing if one of them is wrong or the engines cannot hold such a shape,
/// which is noted at the key or at the table.
template <int Dim>
std::optional<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                     const Material& material);

/// `[shape.NAME]`.
template <int Dim>
std::optional<Shape<Dim>> read_body_shape(TableReader& table, const std::string& name);

}  // namespace talus
