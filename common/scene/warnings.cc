#include "common/scene/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "common/scene/accuracy.h"
#include "common/scene/spout_rate.h"
#include "common/scene/typical_body.h"

namespace talus {
namespace {

using Lines = std::vector<std::string>;

/// The errors of fast pours grow with the distance that a body travels in a step, over its thickness, whatever the
/// solver and its passes (lab/notes/small_steps.md).
template <int Dim>
void warn_of_coarse_steps(const Scene<Dim>& scene, Lines& lines) {
  constexpr double most = 1.0;
  constexpr double fine = 0.5;
  for (std::size_t i = 0; scene.world.ground.present && i < scene.sources.size(); ++i) {
    const Arrival own = arrival(scene.sources[i], scene.world);
    if (own.step(scene.world.dt) <= most * (1.0 + 1e-9)) continue;
    lines.push_back(fmt::format(
        "source[{}]: bodies arrive at {:.3g} m/s and go {:.2g} times their thickness in a step: their pile may "
        "come out a tenth or more too high or low; world.steps_per_second = {:.0f} helps",
        i, own.speed, own.step(scene.world.dt), std::ceil(own.step(1.0) / fine)));
  }
}

template <int Dim>
void warn_of_sources(const Scene<Dim>& scene, Lines& lines) {
  const double end = static_cast<double>(scene.run.frames) / scene.run.frame_rate;
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const Source<Dim>& source = scene.sources[i];
    const double reachable = reachable_rate(source, scene.world);
    if (reachable < source.rate) {
      lines.push_back(fmt::format(
          "source[{}]: is to make {:.4g} bodies a second, but its place is sure to be free only {:.4g} times a "
          "second: bodies may wait; a higher velocity or less spread along it helps",
          i, source.rate, reachable));
    }
    const int at_once = source.bodies_at_once();
    const int before_last = (source.count - 1) / at_once * at_once;
    const double last = source.start + before_last / source.rate;
    if (last > end) {
      lines.push_back(
          fmt::format("source[{}]: its last body is due at {:.4g} s, the run ends at {:.4g} s", i, last, end));
    }
  }
}

/// Events that cannot happen, or that name bodies which the scene does not have.
template <int Dim>
void warn_of_events(const Scene<Dim>& scene, Lines& lines) {
  const double end = static_cast<double>(scene.run.frames) / scene.run.frame_rate;
  const std::int64_t bodies = scene.bodies_planned();
  for (std::size_t i = 0; i < scene.events.size(); ++i) {
    const Event<Dim>& event = scene.events[i];
    if (event.time && *event.time >= end)
      lines.push_back(fmt::format("event[{}]: is due at {:.4g} s, the run ends at {:.4g} s", i, *event.time, end));
    if (event.bodies > bodies)
      lines.push_back(fmt::format("event[{}]: waits for {} bodies, the scene has {}", i, event.bodies, bodies));
    if (const auto beyond =
            std::ranges::find_if(event.numbers, [&](double n) { return n >= static_cast<double>(bodies); });
        beyond != event.numbers.end())
      lines.push_back(fmt::format("event[{}]: there is no body {:g}, the scene has {}", i, *beyond, bodies));
  }
}

// The engines' contact skins and tolerances are made for bodies of about a metre.
template <int Dim>
void warn_of_sizes(const WorldDescription<Dim>& world, Lines& lines) {
  const double smallest = (Dim == 2 ? 0.5 : 0.2) / world.units.lengths();
  const double largest = (Dim == 2 ? 5.0 : 100.0) / world.units.lengths();
  std::map<std::string, std::pair<double, double>> widths;  // of all sizes and variants of a name [m]
  for (const Shape<Dim>& shape : world.shapes) {
    const Vec<Dim> sides = shape.bounds.sizes();
    if (sides.minCoeff() >= smallest && sides.maxCoeff() <= largest) continue;
    const std::pair<double, double> own(sides.minCoeff(), sides.maxCoeff());
    auto& [least, most] = widths.try_emplace(base_name(shape.name), own).first->second;
    least = std::min(least, own.first);
    most = std::max(most, own.second);
  }
  for (const auto& [name, width] : widths)
    lines.push_back(fmt::format("shape.{}: {:.4g} to {:.4g} m wide; contacts are held best between {:.3g} and {:.3g} m",
                                name, width.first, width.second, smallest, largest));
}

// Largest over smallest value among shapes.
template <int Dim>
double ratio(const std::vector<Shape<Dim>>& shapes, double Shape<Dim>::*value) {
  const auto less = [value](const Shape<Dim>& a, const Shape<Dim>& b) { return a.*value < b.*value; };
  const auto [least, most] = std::minmax_element(shapes.begin(), shapes.end(), less);
  return shapes.empty() ? 1.0 : (*most).*value / ((*least).*value);
}

template <int Dim>
void warn_of_mixtures(const Scene<Dim>& scene, Lines& lines) {
  const double masses = ratio(scene.world.shapes, &Shape<Dim>::mass);
  if (masses > 10.0 && !scene.world.solver.small_steps() && scene.world.solver.velocity_iterations < 50) {
    lines.push_back(
        fmt::format("shape: masses differ by a factor of {:.3g}; above 10 heavy bodies sink into light ones unless "
                    "world.solver.velocity_iterations is 50 or more",
                    masses));
  }
  const std::vector<double> bodies = bodies_of_piles(scene);
  std::vector<Shape<Dim>> of_piles;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i] > 0.0) of_piles.push_back(scene.world.shapes[i]);
  const double volumes = ratio(of_piles, &Shape<Dim>::bounding_volume);
  if (volumes > 2.0 && !scene.piles.empty()) {
    lines.push_back(
        fmt::format("shape: bounding boxes differ by a factor of {:.3g} in volume; a pile's layers are made "
                    "for the mean body, so above 2 their densities mean little",
                    volumes));
  }
}

/// Settings of the solver that is not used.
void warn_of_unused_settings(const SolverParams& solver, Lines& lines) {
  const SolverParams usual;
  const auto warn = [&](bool changed, std::string_view name) {
    if (changed)
      lines.push_back(fmt::format("world.solver.{} has no effect: world.solver.kind is \"{}\"", name, solver.kind));
  };
  if (solver.small_steps()) {
    warn(solver.velocity_iterations != usual.velocity_iterations, "velocity_iterations");
    warn(solver.position_iterations != usual.position_iterations, "position_iterations");
    warn(solver.friction_directions != usual.friction_directions, "friction_directions");
  } else {
    warn(solver.sub_steps != usual.sub_steps, "sub_steps");
  }
}

/// Warns of settings without effect: those of the rules where rings are on, those of the rings where they are off.
void warn_of_unused_rules(const AdaptiveParams& params, Lines& lines) {
  const AdaptiveParams usual;
  const auto warn = [&](bool changed, std::string_view name) {
    if (changed)
      lines.push_back(fmt::format("policy.adaptive.{} has no effect: policy.adaptive.rings is {}", name, params.rings));
  };
  if (params.rings > 0) {
    warn(params.wake_height != usual.wake_height, "wake_height");
    warn(params.heavy_impact != usual.heavy_impact, "heavy_impact");
    warn(params.support_slack != usual.support_slack, "support_slack");
    warn(params.avalanche_width != usual.avalanche_width, "avalanche_width");
    warn(params.avalanche_growth != usual.avalanche_growth, "avalanche_growth");
    warn(params.avalanche_angle != usual.avalanche_angle, "avalanche_angle_deg");
  } else {
    warn(params.ring_still_speed != usual.ring_still_speed, "ring_still_speed");
  }
}

template <int Dim>
void warn_of_settings(const Scene<Dim>& scene, Lines& lines) {
  warn_of_unused_settings(scene.world.solver, lines);
  if (scene.policy.kind == "adaptive") warn_of_unused_rules(scene.policy.adaptive, lines);
  if (scene.policy.kind == "paper" && scene.piles.empty())
    lines.emplace_back("policy.kind = \"paper\" without any [[pile]]: no body will ever sleep");
  if (!scene.world.solver.small_steps() && std::ranges::any_of(scene.piles, &PileParams<Dim>::control_slope))
    lines.emplace_back("pile.control_slope has no effect with the engines' own solvers: they raise no friction");
  const double few_steps = 60.0 * scene.world.units.times();
  if (scene.world.dt > 1.0 / few_steps)
    lines.push_back(fmt::format("world.steps_per_second below {:g}: bodies sink visibly into each other", few_steps));
}

/// At 1 twelve balls in a box had up to 2.8 times their energy after a minute, at 0.99 less than before. With small
/// steps the energy of one ball stays within 3 % of what it was, and that of many falls.
template <int Dim>
void warn_of_restitution(const WorldDescription<Dim>& world, Lines& lines) {
  constexpr double lossless = 0.99;
  for (const Shape<Dim>& shape : world.shapes)
    if (shape.material.restitution > lossless && !world.solver.small_steps())
      lines.push_back(
          fmt::format("shape.{}.restitution = {:g}: above {:g} impacts add energy with the engines' own "
                      "solvers, 8 to 180 % in a minute where this was measured; world.solver.kind = "
                      "\"small_steps\" adds 3 % at most",
                      shape.name, shape.material.restitution, lossless));
}

/// Number of the [[obstacle]] that made the obstacles that move as one.
template <int Dim>
std::size_t table_of(const Scene<Dim>& scene, const Mover<Dim>& mover) {
  std::size_t table = 0;
  int end = 0;
  for (; table < scene.obstacles_of_tables.size(); ++table) {
    end += scene.obstacles_of_tables[table];
    if (mover.first < end) break;
  }
  return table;
}

/// Engines keep places in single precision and round each step: a body that is carried by little more than this
/// rounding in a step is carried too far or not at all.
template <int Dim>
void warn_of_coarse_motion(const Scene<Dim>& scene, Lines& lines) {
  constexpr double most = 0.01;
  for (const Mover<Dim>& mover : scene.movers) {
    double farthest = 0.0;
    double arm = 0.0;
    for (int k = mover.first; k < mover.first + mover.count; ++k) {
      const Obstacle<Dim>& obstacle = scene.world.obstacles[k];
      const Box<Dim> bounds = bounds_at(obstacle.shape, obstacle.pose);
      const auto reach = [&bounds](const Vec<Dim>& from) -> Vec<Dim> {
        return (bounds.min() - from).cwiseAbs().cwiseMax((bounds.max() - from).cwiseAbs());
      };
      farthest = std::max(farthest, reach(Vec<Dim>::Zero()).maxCoeff());
      arm = std::max(arm, reach(mover.pivot).norm());
    }
    const double way = (mover.motion.fastest_shift() + arm * mover.motion.fastest_turn()) * scene.world.dt;
    const auto place = static_cast<float>(farthest);
    const double grain = std::nextafter(place, std::numeric_limits<float>::infinity()) - place;
    if (way <= 0.0 || grain / 2.0 <= most * way) continue;
    lines.push_back(
        fmt::format("obstacle[{}].motion: of {:.2g} m a step at most, up to {:.4g} m from the origin, where single "
                    "precision resolves "
                    "{:.2g} m: bodies on it go up to {:.0f} % too far or too short; fewer steps per second or a place "
                    "nearer to the "
                    "origin help",
                    table_of(scene, mover), way, farthest, grain, std::min(100.0, 50.0 * grain / way)));
    return;
  }
}

}  // namespace

template <int Dim>
std::vector<std::string> warnings(const Scene<Dim>& scene) {
  Lines lines = scene.reader_warnings;
  warn_of_sources(scene, lines);
  warn_of_events(scene, lines);
  warn_of_sizes(scene.world, lines);
  warn_of_mixtures(scene, lines);
  warn_of_settings(scene, lines);
  warn_of_restitution(scene.world, lines);
  warn_of_coarse_steps(scene, lines);
  warn_of_coarse_motion(scene, lines);
  return lines;
}

template std::vector<std::string> warnings(const Scene<2>&);
template std::vector<std::string> warnings(const Scene<3>&);

namespace {

using EngineLines = std::vector<std::string>;

template <int Dim>
void warn_of_gravity(const Scene<Dim>& scene, const EngineTraits& engine, EngineLines& lines) {
  const double fall = scene.world.gravity * scene.world.dt * scene.world.dt;
  for (const Shape<Dim>& shape : scene.world.shapes) {
    const double most = engine.sinking_fall * least_width(shape);
    if (fall > most) {
      lines.push_back(fmt::format(
          "world.gravity: a step's fall of {:.3g} m is more than a tenth of the thinnest piece of shape.{} ({:.3g} m): "
          "bodies sink into the ground; world.steps_per_second = {:.0f} helps",
          fall, shape.name, least_width(shape), std::ceil(std::sqrt(scene.world.gravity / most))));
      return;
    }
  }
}

template <int Dim>
void warn_of_speeds(const Scene<Dim>& scene, const EngineTraits& engine, EngineLines& lines) {
  const double fastest = engine.fastest_step / scene.world.dt;
  for (std::size_t i = 0; scene.world.ground.present && i < scene.sources.size(); ++i) {
    const Source<Dim>& source = scene.sources[i];
    const Arrival own = arrival(source, scene.world);
    if (own.speed > fastest) {
      lines.push_back(fmt::format(
          "source[{}]: a fall of {:.4g} m ends at {:.4g} m/s; bodies move by at most {:g} m a step, here {:.4g} m/s; "
          "more steps per second or a lower source help",
          i, own.fall, own.speed, engine.fastest_step, fastest));
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
  const auto bodies = static_cast<double>(scene.bodies_planned());
  auto at_once = static_cast<double>(std::ranges::count(scene.bodies, false, &InitialBody<Dim>::asleep));
  for (const Source<Dim>& source : scene.sources) at_once += std::min(source.count, source.bodies_at_once());
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
  warn_of_demand(scene, engine, lines);
  return lines;
}

template std::vector<std::string> engine_warnings(const Scene<2>&, const EngineTraits&);
template std::vector<std::string> engine_warnings(const Scene<3>&, const EngineTraits&);
template Demand demand(const Scene<2>&, const EngineTraits&);
template Demand demand(const Scene<3>&, const EngineTraits&);

}  // namespace talus
