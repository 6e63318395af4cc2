#pragma once
// Events in scene files.

#include "common/scene/read_shape.h"
#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

/// One `[[event]]`, after all else of the scene. Where shapes were wrong, their names are not checked.
template <int Dim>
Event<Dim> read_event(TableReader& table, const ShapeNames& shapes, const Scene<Dim>& scene);

}  // namespace talus
