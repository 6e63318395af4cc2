#include "common/scene/engine_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/shape/piece.h"

namespace talus {
namespace {

using EngineLines = std::vector<std::string>;

template <int Dim>
double thinnest(const Shape<Dim>& shape) {
  double width = std::numeric_limits<double>::infinity();
  for (const Piece<Dim>& piece : shape.pieces) {
    width = std::min(width, smallest_width(piece));
  }
  return width;
}

template <int Dim>
void warn_of_gravity(const Scene<Dim>& scene, const EngineTraits& engine, EngineLines& lines) {
  const double fall = scene.world.gravity * scene.world.dt * scene.world.dt;
  for (const Shape<Dim>& shape : scene.world.shapes) {
    const double most = engine.sinking_fall * thinnest(shape);
    if (fall > most) {
      lines.push_back(fmt::format(
          "world.gravity: a step's fall of {:.3g} m is more than a tenth of the thinnest piece of shape.{} ({:.3g} m): "
          "bodies sink into the ground; world.steps_per_second = {:.0f} helps",
          fall, shape.name, thinnest(shape), std::ceil(std::sqrt(scene.world.gravity / most))));
      return;
    }
  }
}

// The energy of a free fall to the ground.
template <int Dim>
void warn_of_speeds(const Scene<Dim>& scene, const EngineTraits& engine, EngineLines& lines) {
  const double fastest = engine.fastest_step / scene.world.dt;
  for (std::size_t i = 0; scene.world.ground.present && i < scene.sources.size(); ++i) {
    const Source<Dim>& source = scene.sources[i];
    const double drop = height<Dim>(source.position) + height<Dim>(source.spread) +
                        std::abs(height<Dim>(source.sweep)) + height<Dim>(source.grid_extent()) -
                        scene.world.ground.height;
    const double start = (source.velocity.cwiseAbs() + source.velocity_spread).norm();
    const double arrival = std::sqrt(start * start + 2.0 * scene.world.gravity * std::max(drop, 0.0));
    if (arrival > fastest) {
      lines.push_back(fmt::format(
          "source[{}]: a fall of {:.4g} m ends at {:.4g} m/s; bodies move by at most {:g} m a step, here {:.4g} m/s; "
          "more steps per second or a lower source help",
          i, drop, arrival, engine.fastest_step, fastest));
    }
  }
}

// From 0.99 downwards no engine gained energy; at 1 each does, whatever the restitution threshold.
template <int Dim>
void warn_of_restitution(const Scene<Dim>& scene, const EngineTraits& engine, EngineLines& lines) {
  constexpr double lossless = 0.99;
  for (const Shape<Dim>& shape : scene.world.shapes) {
    if (shape.material.restitution > lossless) {
      lines.push_back(fmt::format(
          "shape.{}.restitution = {:g}: above {:g} impacts add energy, {:.0f} % in a minute where this was measured",
          shape.name, shape.material.restitution, lossless, 100.0 * engine.restitution_gain));
    }
  }
}

template <int Dim>
void warn_of_demand(const Scene<Dim>& scene, const EngineTraits& engine, EngineLines& lines) {
  constexpr double many = 20'000.0;
  const Demand need = demand(scene, engine);
  if (need.awake >= many) {
    lines.push_back(fmt::format("source: {:.0f} bodies awake at once take {:.2g} s a step or more and about {:.2g} GB",
                                need.awake, need.step_seconds, need.bytes * 1e-9));
  }
}

}  // namespace

template <int Dim>
Demand demand(const Scene<Dim>& scene, const EngineTraits& engine) {
  double bodies = 0.0;
  double at_once = 0.0;
  for (const Source<Dim>& source : scene.sources) {
    bodies += source.count;
    at_once += std::min(source.count, source.bodies_at_once());
  }
  Demand need;
  need.awake = scene.policy.kind == "full" ? bodies : at_once;
  need.bytes = need.awake * engine.awake_bytes + (bodies - need.awake) * engine.sleeper_bytes;
  need.step_seconds = need.awake * engine.awake_seconds;
  return need;
}

template <int Dim>
std::vector<std::string> engine_warnings(const Scene<Dim>& scene, const EngineTraits& engine) {
  EngineLines lines;
  warn_of_gravity(scene, engine, lines);
  warn_of_speeds(scene, engine, lines);
  warn_of_restitution(scene, engine, lines);
  warn_of_demand(scene, engine, lines);
  return lines;
}

template std::vector<std::string> engine_warnings(const Scene<2>&, const EngineTraits&);
template std::vector<std::string> engine_warnings(const Scene<3>&, const EngineTraits&);
template Demand demand(const Scene<2>&, const EngineTraits&);
template Demand demand(const Scene<3>&, const EngineTraits&);

}  // namespace talus
