#pragma once
// Every number of a scene as text, so that two scenes can be compared and their difference be read.

#include <fmt/format.h>

#include <string>

#include "common/scene/scene.h"

namespace talus {

template <typename Matrix>
std::string numbers(const Matrix& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    text += fmt::format(" {}", matrix.reshaped()[i]);
  }
  return text;
}

template <int Dim>
std::string numbers(const Pose<Dim>& pose) {
  return numbers(pose.position) + " turned" + numbers(pose.rotation.toRotationMatrix());
}

template <int Dim>
std::string description(const Shape<Dim>& shape) {
  std::string text =
      fmt::format("{}: density {} friction {} restitution {} mass {} inertia{} bounds{}{}\n", shape.name,
                  shape.material.density, shape.material.friction, shape.material.restitution, shape.mass,
                  numbers(shape.inertia), numbers(shape.bounds.min()), numbers(shape.bounds.max()));
  return text;
}

template <int Dim>
std::string description(const WorldDescription<Dim>& world) {
  std::string text = fmt::format(
      "gravity {} dt {} solver {} {} {} {} {} engine_sleep {}\nground {} {} {} {}\n", world.gravity, world.dt,
      world.solver.velocity_iterations, world.solver.position_iterations, world.solver.friction_directions,
      world.solver.warm_friction, world.solver.restitution_threshold, world.engine_sleep, world.ground.present,
      world.ground.height, world.ground.material.friction, world.ground.material.restitution);
  for (const Skip& skip : all_skips) {
    text += fmt::format("skip {} {}\n", skip.name, world.skips.*skip.field);
  }
  for (const Obstacle<Dim>& obstacle : world.obstacles) {
    text += "obstacle at" + numbers(obstacle.pose) + " " + description(obstacle.shape);
  }
  for (const Shape<Dim>& shape : world.shapes) {
    text += "shape " + description(shape);
  }
  return text;
}

template <int Dim>
std::string description(const Source<Dim>& source) {
  std::string text = "source of";
  for (const int shape : source.shapes) {
    text += fmt::format(" {}", shape);
  }
  text += fmt::format(" count {} start {} rate {} spin_spread {} sweep_period {} ride_above {}", source.count,
                      source.start, source.rate, source.spin_spread, source.sweep_period, source.ride_above);
  text += " grid" + numbers(source.grid) + " spacing" + numbers(source.spacing);
  for (const Vec<Dim>& vector :
       {source.position, source.spread, source.velocity, source.velocity_spread, source.sweep}) {
    text += " /" + numbers(vector);
  }
  return text + (source.orientation ? " turned" + numbers(source.orientation->toRotationMatrix()) : " random") + "\n";
}

template <int Dim>
std::string description(const PileParams<Dim>& pile) {
  std::string text = fmt::format("pile {} {} {} {} {}", pile.alpha.value_or(0.0), pile.initial_size, pile.growth_ratio,
                                 pile.merge_distance, pile.drift_rate);
  if (pile.control_slope) text += " controls its slope";
  if (pile.count_flying) text += *pile.count_flying ? " counts flying" : " does not count flying";
  text += pile.at ? " at" + numbers(*pile.at) : " where the first lands";
  if (pile.boundary) {
    text += fmt::format(" rim {} radius {}", pile.boundary->rim, pile.boundary->cylinder_radius);
    for (const Wall<Dim>& wall : pile.boundary->walls) {
      text += fmt::format(" wall {} {}", wall.distance, numbers(wall.normal));
    }
  }
  return text + "\n";
}

/// Everything but the TOML that it came from.
template <int Dim>
std::string description(const Scene<Dim>& scene) {
  std::string text = fmt::format("{}, {}D, seed {}\n", scene.title, Dim, scene.seed) + description(scene.world);
  for (const Source<Dim>& source : scene.sources) {
    text += description(source);
  }
  for (const PileParams<Dim>& pile : scene.piles) {
    text += description(pile);
  }
  const AdaptiveParams& own = scene.policy.adaptive;
  text += fmt::format("adaptive {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", own.rest_distance,
                      own.rest_time_deep, own.rest_time_surface, own.rest_distance_woken, own.rest_time_woken,
                      own.wake_height, own.heavy_impact, own.support_slack, own.awake_share, own.avalanche_width,
                      own.avalanche_growth, own.avalanche_growth_quiet, own.avalanche_angle,
                      own.slope_proportional_gain, own.slope_integral_gain, own.slope_max_damping);
  const PaperParams& paper = scene.policy.paper;
  return text + fmt::format("policy {} {} {} {} {}\nrun {} at {}\n", scene.policy.kind, paper.tau,
                            fmt::join(paper.avalanche_density, " "), paper.awake_steps, paper.wake_speed,
                            scene.run.frames, scene.run.frame_rate);
}

}  // namespace talus
