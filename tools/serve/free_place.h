#pragma once

#include <optional>

#include "common/measure/supports_of.h"
#include "common/world/world.h"

namespace talus {

/// The lowest place from `place` [m] upwards, in tenths of the shape's extent, at which an unturned body of this shape
/// touches neither a body nor ground or obstacle; none within a hundred extents.
template <int Dim>
std::optional<Vec<Dim>> free_place(const World<Dim>& world, const FixedSupports& fixed, int shape,
                                   const Vec<Dim>& place);

}  // namespace talus
