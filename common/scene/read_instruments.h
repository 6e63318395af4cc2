#pragma once
// Gates, regions and loads in scene files.

#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

/// All `[[gate]]`, `[[region]]` and `[[load]]` of a scene, after its ground and its obstacles.
template <int Dim>
void read_instruments(TableReader& root, Scene<Dim>& scene);

}  // namespace talus
