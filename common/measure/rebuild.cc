#include "common/measure/rebuild.h"

#include <algorithm>
#include <vector>

#include "common/scene/accuracy.h"

namespace talus {
namespace {

constexpr double reference_steps_per_second = 120.0;

}  // namespace

template <int Dim>
std::unique_ptr<World<Dim>> rebuild(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                                    const BodyStates<Dim>& states, Sleepers sleepers) {
  std::unique_ptr<World<Dim>> world = make_world(description);
  std::vector<BodyIndex> asleep;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    world->add({states.shape[body], states.pose[body],
                limited(states.velocity[body], fastest_speed<Dim>(description.dt, description.units)),
                limited(states.spin[body], fastest_spin(description.dt))});
    if (body < std::ssize(states.grip) && !states.removed[body]) world->set_grip(body, states.grip[body]);
    if (states.removed[body])
      world->remove(body);
    else if (states.asleep[body])
      asleep.push_back(body);
  }
  if (sleepers == Sleepers::frozen) world->freeze(asleep);
  return world;
}

template <int Dim>
WorldDescription<Dim> reference_settings(WorldDescription<Dim> description) {
  description.dt = std::min(description.dt, 1.0 / reference_steps_per_second);
  description.engine_sleep = false;
  description.solver.velocity_iterations = std::max(description.solver.velocity_iterations, 50);
  description.solver.position_iterations = std::max(description.solver.position_iterations, 20);
  description.solver.friction_directions = 2;
  return description;
}

template std::unique_ptr<World<2>> rebuild(const WorldMaker<2>&, const WorldDescription<2>&, const BodyStates<2>&,
                                           Sleepers);
template std::unique_ptr<World<3>> rebuild(const WorldMaker<3>&, const WorldDescription<3>&, const BodyStates<3>&,
                                           Sleepers);

template <int Dim>
Scene<Dim> reference_scene(Scene<Dim> scene) {
  const double steps = fitting_steps_per_second(scene, 0.25, reference_steps_per_second * scene.world.units.steps());
  scene.policy.kind = "full";
  scene.world = reference_settings(scene.world);
  scene.world.solver.sub_steps = std::max(scene.world.solver.sub_steps, usual_sub_steps);
  scene.world.dt = std::min(scene.world.dt, 1.0 / steps);
  return scene;
}

template <int Dim>
WorldDescription<Dim> judging_settings(const WorldDescription<Dim>& description) {
  return description.solver.small_steps() ? description : reference_settings(description);
}

template WorldDescription<2> reference_settings(WorldDescription<2>);
template WorldDescription<3> reference_settings(WorldDescription<3>);
template Scene<2> reference_scene(Scene<2>);
template Scene<3> reference_scene(Scene<3>);
template WorldDescription<2> judging_settings(const WorldDescription<2>&);
template WorldDescription<3> judging_settings(const WorldDescription<3>&);

}  // namespace talus
