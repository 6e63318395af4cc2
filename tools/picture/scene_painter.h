#pragma once
// The scene itself, without title and legend.

#include "tools/picture/canvas.h"
#include "tools/picture/framing.h"
#include "tools/picture/projection.h"

namespace talus {

/// The scene on a page of width x height [px]: obstacles, bodies, layers, their densities, the ground. All that takes
/// time is done once, here; what it refers to must outlive the painter.
Painter scene_painter(const PictureInput<2>& input, const Framing<2>& framing, const Projection<2>& projection,
                      const PictureParams& params, int width, int height);
Painter scene_painter(const PictureInput<3>& input, const Framing<3>& framing, const Projection<3>& projection,
                      const PictureParams& params, int width, int height);

}  // namespace talus
