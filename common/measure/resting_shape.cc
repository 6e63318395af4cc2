#include "common/measure/resting_shape.h"

namespace talus {

template <int Dim>
std::vector<PlacedBody<Dim>> resting_bodies(const Scene<Dim>& scene, const BodyStates<Dim>& states) {
  return placed_bodies<Dim>(scene.world.shapes, states, fastest_at_rest(scene.world));
}

template <int Dim>
std::optional<ShapeStatistics<Dim>> resting_shape(const Scene<Dim>& scene, const BodyStates<Dim>& states,
                                                  double extent) {
  const auto bodies = resting_bodies(scene, states);
  if (bodies.empty()) return std::nullopt;
  return shape_statistics<Dim>(bodies, grid_around<Dim>(bodies, scene.world.ground.height, extent));
}

template <int Dim>
PileForm resting_form(const Scene<Dim>& scene, const BodyStates<Dim>& states, const WorldDescription<Dim>& world,
                      double extent) {
  const auto bodies = resting_bodies(scene, states);
  if (bodies.empty()) return {.slope = {.why_not = "no body rests"}, .packing = {.why_not = "no body rests"}};
  const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, scene.world.ground.height, extent);
  return pile_form<Dim>(bodies, shape_statistics<Dim>(bodies, grid), grid, world, extent);
}

template std::vector<PlacedBody<2>> resting_bodies(const Scene<2>&, const BodyStates<2>&);
template std::vector<PlacedBody<3>> resting_bodies(const Scene<3>&, const BodyStates<3>&);
template std::optional<ShapeStatistics<2>> resting_shape(const Scene<2>&, const BodyStates<2>&, double);
template std::optional<ShapeStatistics<3>> resting_shape(const Scene<3>&, const BodyStates<3>&, double);
template PileForm resting_form(const Scene<2>&, const BodyStates<2>&, const WorldDescription<2>&, double);
template PileForm resting_form(const Scene<3>&, const BodyStates<3>&, const WorldDescription<3>&, double);

}  // namespace talus
