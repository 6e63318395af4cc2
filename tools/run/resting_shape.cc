#include "tools/run/resting_shape.h"

namespace talus {

template <int Dim>
std::optional<ShapeStatistics<Dim>> resting_shape(const Scene<Dim>& scene, const BodyStates<Dim>& states,
                                                  double extent) {
  constexpr double fastest_at_rest = 1.0;  // [m/s]
  const auto bodies = placed_bodies<Dim>(scene.world.shapes, states, fastest_at_rest);
  if (bodies.empty()) return std::nullopt;
  return shape_statistics<Dim>(bodies, grid_around<Dim>(bodies, scene.world.ground.height, extent), extent);
}

template std::optional<ShapeStatistics<2>> resting_shape(const Scene<2>&, const BodyStates<2>&, double);
template std::optional<ShapeStatistics<3>> resting_shape(const Scene<3>&, const BodyStates<3>&, double);

}  // namespace talus
