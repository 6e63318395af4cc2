#pragma once

#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

/// The whole of a scene file. Where errors were noted, what comes back is of no use.
template <int Dim>
Scene<Dim> read_root(TableReader& root);

}  // namespace talus
