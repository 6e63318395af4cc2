#pragma once
// Keys that several tables of a scene file share.

#include <optional>
#include <string>
#include <vector>

#include "common/math/vector.h"
#include "common/scene/table_reader.h"
#include "common/shape/shape.h"

namespace talus {

/// The table's `kind`, which must be one of `kinds`; noted and empty if it is none.
std::string read_kind(TableReader& table, const std::vector<std::string>& kinds);

/// Friction and restitution.
void read_surface(TableReader& table, Material& material);

/// Dim lengths that must be given.
template <int Dim>
Vec<Dim> read_size(TableReader& table, std::string_view key);

/// `angle_deg`, in 3D about `axis`; nothing if neither is given.
template <int Dim>
std::optional<Rotation<Dim>> read_rotation(TableReader& table);

}  // namespace talus
