#pragma once

#include "common/pile/pile.h"
#include "common/scene/scene.h"

namespace talus {

/// What the scene's bodies are taken to be like: v_obj and mass are means over all bodies that the sources will drop,
/// D is the largest. Of a scene without sources: over its shapes.
template <int Dim>
TypicalBody typical_body(const Scene<Dim>& scene);

}  // namespace talus
