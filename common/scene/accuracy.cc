#include "common/scene/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "common/math/vector.h"
#include "common/shape/shape.h"

namespace talus {
namespace {

/// The source of which a body goes farthest in a step, over its thickness; nothing without ground or sources.
template <int Dim>
std::optional<Arrival> coarsest_arrival(const Scene<Dim>& scene) {
  std::optional<Arrival> coarsest;
  for (std::size_t i = 0; scene.world.ground.present && i < scene.sources.size(); ++i) {
    const Arrival own = arrival(scene.sources[i], scene.world);
    if (!coarsest || own.step(1.0) > coarsest->step(1.0)) coarsest = own;
  }
  return coarsest;
}

/// Where the rules for sleeping bodies that feel no forces go wrong at any accuracy: what moves slowly wakes
/// none, and a load on a sleeping body has no effect on what carries it.
template <int Dim>
bool needs_rings(const Scene<Dim>& scene) {
  return !scene.movers.empty() || scene.gravity_motion || !scene.events.empty() || !scene.instruments.loads.empty();
}

template <int Dim>
const Accuracy& level_of(const Scene<Dim>& scene) {
  return *std::ranges::find(accuracies, scene.accuracy, &Accuracy::name);
}

template <int Dim>
int usual_rings_of(const Scene<Dim>& scene, const Accuracy& level) {
  if (!scene.world.solver.small_steps()) return 0;
  return needs_rings(scene) ? usual_rings : level.rings;
}

}  // namespace

template <int Dim>
Arrival arrival(const Source<Dim>& source, const WorldDescription<Dim>& world) {
  const double fall = height<Dim>(source.position) + height<Dim>(source.spread) + std::abs(height<Dim>(source.sweep)) +
                      height<Dim>(source.grid_extent()) - world.ground.height;
  const double start = (source.velocity.cwiseAbs() + source.velocity_spread).norm();
  double least = std::numeric_limits<double>::infinity();
  for (const int shape : source.shapes) least = std::min(least, thickness(world.shapes[shape]));
  return {fall, std::sqrt(start * start + 2.0 * world.gravity * std::max(fall, 0.0)), least};
}

template <int Dim>
double fitting_steps_per_second(const Scene<Dim>& scene, double step, std::optional<double> least_given) {
  constexpr double finest = 8.0;
  const double least = least_given.value_or(usual_steps_per_second(scene.world));
  const double frames = scene.run.frame_rate;
  const std::optional<Arrival> coarsest = coarsest_arrival(scene);
  const double needed = coarsest ? std::min(coarsest->step(1.0) / step, finest * least) : least;
  const double base = frames * std::ceil(least / frames - 1e-9);
  return base * std::max(1.0, std::ceil(needed / base - 1e-9));
}

template <int Dim>
void apply_accuracy(Scene<Dim>& scene, const SetByScene& set) {
  const Accuracy& level = level_of(scene);
  if (!set.steps) scene.world.dt = 1.0 / fitting_steps_per_second(scene, level.step);
  if (!set.sub_steps && scene.world.solver.small_steps()) scene.world.solver.sub_steps = level.sub_steps[Dim - 2];
  if (!set.tolerance) scene.policy.adaptive.tolerance = level.tolerance;
  if (!set.rings) scene.policy.adaptive.rings = usual_rings_of(scene, level);
}

template <int Dim>
std::optional<double> calibrated_error(const Scene<Dim>& scene) {
  const Accuracy& level = level_of(scene);
  if (!scene.world.solver.small_steps() || scene.policy.kind != "adaptive") return std::nullopt;
  Scene<Dim> of_level = scene;
  apply_accuracy(of_level, {});
  const auto settings = [](const Scene<Dim>& of) {
    return std::tuple(of.world.dt, of.world.solver.sub_steps, of.policy.adaptive.tolerance, of.policy.adaptive.rings);
  };
  return settings(scene) == settings(of_level) ? std::optional(level.error) : std::nullopt;
}

template <int Dim>
std::string accuracy_text(const Scene<Dim>& scene) {
  const WorldDescription<Dim>& world = scene.world;
  std::string text = fmt::format("accuracy {}", scene.accuracy);
  if (const auto error = calibrated_error(scene))
    text += fmt::format(", typical error of a poured heap's shape {:g} %", 100.0 * *error);
  text += fmt::format(": {:.6g} steps a second", 1.0 / world.dt);
  if (world.solver.small_steps()) text += fmt::format(" of {} sub-steps", world.solver.sub_steps);
  if (const auto coarsest = coarsest_arrival(scene))
    text += fmt::format(", bodies arrive at {:.3g} m/s and go {:.2g} times their thickness in a step", coarsest->speed,
                        coarsest->step(world.dt));
  if (world.units.power != 0)
    text += fmt::format(", simulated {:g} times as large and {:g} times as slowly", world.units.lengths(),
                        world.units.times());
  if (const auto tolerance = scene.policy.tolerance()) text += fmt::format(", tolerance {:g} D", *tolerance);
  if (const int rings = scene.policy.rings(); rings > 0) text += fmt::format(", {} rings", rings);
  return text;
}

template Arrival arrival(const Source<2>&, const WorldDescription<2>&);
template Arrival arrival(const Source<3>&, const WorldDescription<3>&);
template double fitting_steps_per_second(const Scene<2>&, double, std::optional<double>);
template double fitting_steps_per_second(const Scene<3>&, double, std::optional<double>);
template void apply_accuracy(Scene<2>&, const SetByScene&);
template void apply_accuracy(Scene<3>&, const SetByScene&);
template std::optional<double> calibrated_error(const Scene<2>&);
template std::optional<double> calibrated_error(const Scene<3>&);
template std::string accuracy_text(const Scene<2>&);
template std::string accuracy_text(const Scene<3>&);

}  // namespace talus
