#pragma once
// Every number of a scene as text, so that two scenes can be compared and their difference be read.

#include <fmt/format.h>

#include <string>

#include "common/pile/pile_fields.h"
#include "common/scene/policy_fields.h"
#include "common/scene/scene.h"
#include "common/scene/scene_fields.h"
#include "common/scene/toml_text.h"
#include "common/shape/shape_fields.h"
#include "common/world/world_fields.h"

namespace talus {

template <typename Matrix>
std::string numbers(const Matrix& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) text += fmt::format(" {}", matrix.reshaped()[i]);
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

/// All fields of a struct by name.
template <typename S>
std::string description(const S& params, std::type_identity_t<Fields<S>> fields) {
  std::string text;
  for (const Field<S>& field : fields) {
    const auto add = [&](auto where) {
      if constexpr (!std::is_same_v<decltype(where), std::monostate>)
        text += fmt::format("{} = {}\n", field.key.name, field_text(field.key, *where));
    };
    std::visit(add, value_of(params, field));
  }
  return text;
}

template <int Dim>
std::string description(const WorldDescription<Dim>& world) {
  std::string text = description(world, world_fields<Dim>) + description(world.solver, solver_fields) +
                     description(world.ground, ground_fields) + description(world.ground.material, surface_fields) +
                     fmt::format("engine_sleep {} dt {}\n", world.engine_sleep, world.dt);
  for (const Obstacle<Dim>& obstacle : world.obstacles)
    text += "obstacle at" + numbers(obstacle.pose) + " " + description(obstacle.shape);
  for (const Shape<Dim>& shape : world.shapes) text += "shape " + description(shape);
  return text;
}

template <int Dim>
std::string description(const Source<Dim>& source) {
  return fmt::format("source of {}\n", fmt::join(source.shapes, " ")) + description(source, source_fields<Dim>) +
         (source.orientation ? "turned" + numbers(source.orientation->toRotationMatrix()) : "random") + "\n";
}

template <int Dim>
std::string description(const PileParams<Dim>& pile) {
  std::string text = "pile\n" + description(pile, pile_fields<Dim>);
  if (pile.boundary) {
    text += fmt::format(" rim {} radius {}", pile.boundary->rim, pile.boundary->cylinder_radius);
    for (const Wall<Dim>& wall : pile.boundary->walls)
      text += fmt::format(" wall {} {}", wall.distance, numbers(wall.normal));
  }
  return text + "\n";
}

template <int Dim>
std::string description(const InitialBody<Dim>& body) {
  return fmt::format("body of {} at{} velocity{} spin{} asleep {}\n", body.def.shape, numbers(body.def.pose),
                     numbers(body.def.velocity), numbers(body.def.spin), body.asleep);
}

/// Everything but the TOML that it came from.
template <int Dim>
std::string description(const Scene<Dim>& scene) {
  std::string text = fmt::format("{}, {}D, seed {}\n", scene.title, Dim, scene.seed) + description(scene.world);
  for (const InitialBody<Dim>& body : scene.bodies) text += description(body);
  for (const Source<Dim>& source : scene.sources) text += description(source);
  for (const PileParams<Dim>& pile : scene.piles) text += description(pile);
  return text + description(scene.policy, policy_fields) + description(scene.policy.paper, paper_fields) +
         description(scene.policy.adaptive, adaptive_fields) + description(scene.run, run_fields);
}

}  // namespace talus
