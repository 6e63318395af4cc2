#pragma once
// The shape of what lies still enough to be part of the pile.

#include <optional>
#include <vector>

#include "common/measure/pile_form.h"
#include "common/scene/scene.h"

namespace talus {

/// The speed up to which a body is part of the pile [m/s], 1 m/s in worlds of usual size: what still falls is none.
template <int Dim>
double fastest_at_rest(const WorldDescription<Dim>& world) {
  return 1.0 / world.units.speeds();
}

/// Bodies in the world that are no faster.
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
