#pragma once
// How large the scene is drawn, and where on the page.

#include "tools/picture/framing.h"
#include "tools/picture/page.h"
#include "tools/picture/projection.h"

namespace talus {

template <int Dim>
struct Layout {
  Projection<Dim> projection;  // from the world to the page
  int height = 0;              // of the page [px]
};

/// All that is framed fits between the page's header and footer, with room for labels at its sides. The page is as high
/// as this needs, within limits.
template <int Dim>
Layout<Dim> lay_out(const Framing<Dim>& framing, const Page& page, const PictureParams& params);

}  // namespace talus
