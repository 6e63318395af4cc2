#pragma once

#include <optional>

#include "common/measure/shape_statistics.h"
#include "common/scene/scene.h"

namespace talus {

/// The shape of the bodies that move with at most 1 m/s, as summary.json has it: what still falls is no part of the
/// pile. `extent` is D [m] > 0. Nothing where there is no such body.
template <int Dim>
std::optional<ShapeStatistics<Dim>> resting_shape(const Scene<Dim>& scene, const BodyStates<Dim>& states,
                                                  double extent);

}  // namespace talus
