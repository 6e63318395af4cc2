#pragma once
// Contact forces as lines.

#include "tools/picture/canvas.h"
#include "tools/picture/picture.h"
#include "tools/picture/projection.h"

namespace talus {

/// PictureInput::force_scale, else the force above which one line in five lies, with two digits [N]. 0: no lines.
template <int Dim>
double force_scale(const PictureInput<Dim>& input);

/// Draws a line between the middles of each two bodies that touch, and from the middle of a body to each of its contact
/// points with ground or an obstacle: as wide as the sum of the normal forces is large.
template <int Dim>
void paint_chains(cairo_t* canvas, const PictureInput<Dim>& input, const Projection<Dim>& projection,
                  const PictureParams& params);

}  // namespace talus
