#pragma once

#include <span>
#include <string>

#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

/// All sources together drop no more: states and records of ten million bodies fill a machine of today.
inline constexpr int most_bodies = 10'000'000;

/// One `[[source]]`. `shape_names` in the order of world.shapes; without them, if shapes were wrong, what needs them is
/// not looked at.
template <int Dim>
Source<Dim> read_source(TableReader& table, std::span<const std::string> shape_names,
                        const WorldDescription<Dim>& world);

}  // namespace talus
