#pragma once

#include "common/shape/shape.h"

namespace talus {

/// Radius [m] of the smallest sphere about the centre of mass that holds the shape however it is turned.
template <int Dim>
double bounding_radius(const Shape<Dim>& shape);

}  // namespace talus
