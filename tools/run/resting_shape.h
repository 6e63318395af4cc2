#pragma once

#include <optional>
#include <vector>

#include "common/measure/shape_statistics.h"
#include "common/scene/scene.h"

namespace talus {

/// Bodies in the world that move with at most 1 m/s: what still falls is no part of the pile.
template <int Dim>
std::vector<PlacedBody<Dim>> resting_bodies(const Scene<Dim>& scene, const BodyStates<Dim>& states);

/// Their shape, as summary.json has it. `extent` is D [m] > 0. Nothing where there is no such body.
template <int Dim>
std::optional<ShapeStatistics<Dim>> resting_shape(const Scene<Dim>& scene, const BodyStates<Dim>& states,
                                                  double extent);

}  // namespace talus
