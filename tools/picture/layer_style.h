#pragma once
// Style of layers in 2D and 3D.

#include <vector>

#include "common/pile/pile.h"
#include "tools/picture/canvas.h"

namespace talus {

/// Denser layers are less translucent.
double layer_opacity(const Layer& layer);

/// Writes densities beside layers that hold bodies, and leaves out those that would cover another.
class DensityLabels {
 public:
  explicit DensityLabels(const PictureParams& params) : params_(params) {}
  /// The middle of the label's left side comes to lie right of `at`.
  void draw(cairo_t* canvas, const Vec2& at, const Layer& layer);

 private:
  const PictureParams& params_;
  std::vector<Box<2>> taken_;
};

}  // namespace talus
