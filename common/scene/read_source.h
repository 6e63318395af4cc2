#pragma once

#include <span>
#include <string>

#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

/// One `[[source]]`. `shape_names` in the order of world.shapes; where shapes were wrong, rules that depend on them are
/// not checked.
template <int Dim>
Source<Dim> read_source(TableReader& table, std::span<const std::string> shape_names,
                        const WorldDescription<Dim>& world);

}  // namespace talus
