#pragma once
// How the layers of a pile are drawn, in 2D and 3D.

#include <vector>

#include "common/pile/pile.h"
#include "tools/picture/canvas.h"

namespace talus {

/// The same pile cut into `most` layers or fewer, each made of as many neighbours: thinner ones would be nothing but
/// lines. `most` > 0.
template <int Dim>
Pile<Dim> with_coarse_layers(Pile<Dim> pile, int most);

/// Where a layer ends, `height` above the pile's base: in 2D its left and right end, in 3D points around it, a circle
/// or the shape of the walls that the pile fills, counter-clockwise seen from above.
template <int Dim>
std::vector<Vec<Dim>> layer_rim(const Pile<Dim>& pile, const Layer& layer, double height);

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
