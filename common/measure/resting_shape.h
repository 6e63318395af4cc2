#pragma once
// The shape of what lies still enough to be part of the pile.

#include <optional>
#include <vector>

#include "common/measure/pile_form.h"
#include "common/scene/scene.h"

namespace talus {

/// Bodies in the world that move with at most 1 m/s: what still falls is no part of the pile.
template <int Dim>
std::vector<PlacedBody<Dim>> resting_bodies(const Scene<Dim>& scene, const BodyStates<Dim>& states);

/// Their shape, as summary.json has it. `extent` is D [m] > 0. Nothing where there is no such body.
template <int Dim>
std::optional<ShapeStatistics<Dim>> resting_shape(const Scene<Dim>& scene, const BodyStates<Dim>& states,
                                                  double extent);

/// Slope and packing of that shape, where they apply (pile_form()). `world` is as it is at that moment (world_at()).
template <int Dim>
PileForm resting_form(const Scene<Dim>& scene, const BodyStates<Dim>& states, const WorldDescription<Dim>& world,
                      double extent);

}  // namespace talus
