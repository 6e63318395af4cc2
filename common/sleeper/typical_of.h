#pragma once

#include <vector>

#include "common/pile/pile.h"
#include "common/shape/shape.h"

namespace talus {

/// The typical body of a heap of bodies with these shapes, at least one: mean bounding volume and mass, and the largest
/// extent when the largest fiftieth is left out.
template <int Dim>
TypicalBody typical_of(const std::vector<const Shape<Dim>*>& shapes);

}  // namespace talus
