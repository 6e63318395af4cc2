#pragma once
// The edge of a pile's layer at one height.

#include <vector>

#include "common/pile/pile.h"

namespace talus {

/// Where a layer ends, `height` above the pile's base: in 2D its left and right end, in 3D points around it, a circle
/// or the shape of the walls that the pile fills, counter-clockwise seen from above.
template <int Dim>
std::vector<Vec<Dim>> layer_rim(const Pile<Dim>& pile, const Layer& layer, double height);

}  // namespace talus
