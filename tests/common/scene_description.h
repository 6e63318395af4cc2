#pragma once
// Every number of a scene as text, so that two scenes can be compared and their difference be read.

#include <fmt/format.h>

#include <string>

#include "common/pile/pile_fields.h"
#include "common/scene/instrument_fields.h"
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
std::string description(const Shape<Dim>& shape) {
  return fmt::format("{}: mass {} inertia{} bounds{}{}\n", shape.name, shape.mass, numbers(shape.inertia),
                     numbers(shape.bounds.min()), numbers(shape.bounds.max())) +
         description(shape.material, surface_fields) + description(shape.material, body_material_fields);
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

template <int Dim>
std::string description(const Motion<Dim>& motion) {
  std::string text = fmt::format("motion{} {} {}{} from {} to {} times {} angles {} axis{}", numbers(motion.amplitude),
                                 motion.frequency, motion.speed, numbers(motion.belt), motion.start,
                                 motion.end ? fmt::format("{}", *motion.end) : "its last step",
                                 fmt::join(motion.times, " "), fmt::join(motion.angles, " "), numbers(motion.axis));
  for (const Vec<Dim>& shift : motion.shifts) text += " shift" + numbers(shift);
  return text + "\n";
}

template <int Dim>
std::string description(const Event<Dim>& event) {
  return fmt::format("event {} of {} obstacle {}\n", to_string(event.action), fmt::join(event.shapes, " "),
                     event.obstacle.value_or(-1)) +
         description(event, event_fields<Dim>);
}

template <int Dim>
std::string description(const Instruments<Dim>& instruments) {
  std::string text;
  for (const GateParams<Dim>& gate : instruments.gates) text += "gate\n" + description(gate, gate_fields<Dim>);
  for (const RegionParams<Dim>& region : instruments.regions)
    text += "region\n" + description(region, region_fields<Dim>);
  for (const LoadParams<Dim>& load : instruments.loads)
    text += fmt::format("load on {} {}\n", load.on_ground, fmt::join(load.obstacles, " ")) +
            description(load, load_fields<Dim>);
  return text;
}

/// Everything but the TOML that it came from.
template <int Dim>
std::string description(const Scene<Dim>& scene) {
  std::string text = fmt::format("{}, {}D, seed {}\n", scene.title, Dim, scene.seed) + description(scene.world);
  for (const InitialBody<Dim>& body : scene.bodies) text += description(body);
  for (const Source<Dim>& source : scene.sources) text += description(source);
  for (const Mover<Dim>& mover : scene.movers)
    text += fmt::format("mover {} {}{} ", mover.first, mover.count, numbers(mover.pivot)) + description(mover.motion);
  if (scene.gravity_motion) text += "gravity " + description(*scene.gravity_motion);
  for (const ObstacleName& name : scene.obstacle_names)
    text += fmt::format("obstacles {} {} {}\n", name.name, name.first, name.count);
  for (const Event<Dim>& event : scene.events) text += description(event);
  for (const PileParams<Dim>& pile : scene.piles) text += description(pile);
  text += description(scene.instruments) + scene.accuracy + "\n";
  return text + description(scene.policy, policy_fields) + description(scene.policy.paper, paper_fields) +
         description(scene.policy.adaptive, adaptive_fields) + description(scene.run, run_fields);
}

}  // namespace talus
