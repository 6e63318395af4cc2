#include "tests/physics/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/measure/support.h"
#include "common/scene/window.h"
#include "common/world/energy.h"
#include "tools/run/backends.h"
#include "tools/run/make_simulation.h"

namespace talus {
namespace {

/// Bodies nearer than this may carry each other: engines hold them apart by up to 0.04 m.
constexpr double touching = 0.05;

}  // namespace

template <int Dim>
StageRun<Dim>::StageRun(const Scene<Dim>& scene, const std::string& backend)
    : description_(scene.world), simulation_(make_simulation(scene, backend)) {
  simulation_.add_observer(*watcher_);
}

template <int Dim>
void StageRun<Dim>::until(double time, const std::function<void()>& each) {
  while (simulation_.time() < time - 0.5 * description_.dt) {
    simulation_.step();
    if (each) each();
  }
}

template <int Dim>
int StageRun<Dim>::floating() const {
  return static_cast<int>(floating_sleepers<Dim>(states(), touching_pairs(description_, states(), touching)).size());
}

template <int Dim>
double StageRun<Dim>::penetration() const {
  const auto pairs = touching_pairs(description_, states(), touching);
  return talus::penetration(pairs).max;
}

template <int Dim>
double StageRun<Dim>::energy() const {
  double sum = 0.0;
  for (BodyIndex body = 0; body < states().size(); ++body) {
    if (states().removed[body] != 0) continue;
    sum += kinetic_energy(world(), body) +
           world().shape_of(body).mass * description_.gravity * height<Dim>(states().pose[body].position);
  }
  return sum;
}

template <int Dim>
Stage<Dim>::Stage(const PhysicsCell& cell, const Material& ground) : backend(cell.backend) {
  scene.title = "physics";
  scene.policy.kind = std::string(cell.policy);
  scene.world.engine_sleep = cell.policy == "engine";
  scene.world.solver.kind = scene.world.engine_sleep ? engine_solver : cell.solver;
  scene.policy.adaptive.rings = scene.world.solver.small_steps() ? cell.rings : 0;
  scene.world.ground.material = ground;
  scene.run.frames = 1'000'000'000;
  scene.run.frame_rate = 60.0;
  scene.piles.resize(1);
  scene.piles.front().at = Vec<Dim>::Zero();
}

template <int Dim>
StageRun<Dim> Stage<Dim>::run() const {
  for (const SceneError& outside : outside_window(scene, engine_traits<Dim>(backend), "scene"))
    throw std::logic_error(fmt::format("{}: {}", outside.field, outside.rule));
  return StageRun<Dim>(scene, backend);
}

template <int Dim>
int Stage<Dim>::shape(std::vector<Piece<Dim>> pieces, const Material& material) {
  const auto number = scene.world.shapes.size();
  scene.world.shapes.push_back(make_shape<Dim>(fmt::format("s{}", number), std::move(pieces), material));
  return static_cast<int>(number);
}

template <int Dim>
BodyIndex Stage<Dim>::body(int shape, const Vec<Dim>& centre, double angle, const Vec<Dim>& velocity,
                           const Spin<Dim>& spin) {
  scene.bodies.push_back({{shape, {centre, turned<Dim>(angle)}, velocity, spin}, false});
  return static_cast<BodyIndex>(scene.bodies.size() - 1);
}

template <int Dim>
int Stage<Dim>::fixed_box(const Vec<Dim>& size, const Vec<Dim>& centre, double angle, const Material& material) {
  const auto number = scene.world.obstacles.size();
  scene.world.obstacles.push_back({make_shape<Dim>(fmt::format("o{}", number), box_pieces<Dim>(size), material),
                                   {centre, turned<Dim>(angle)},
                                   false});
  return static_cast<int>(number);
}

template <int Dim>
void Stage<Dim>::move(int first, const Motion<Dim>& motion) {
  auto& obstacles = scene.world.obstacles;
  const int count = static_cast<int>(obstacles.size()) - first;
  for (int i = first; i < first + count; ++i) obstacles[i].moves = true;
  scene.movers.push_back({first, count, obstacles[first].pose.position, motion});
}

namespace {

/// Calls `use` with the way of each body that is still there.
template <int Dim, class Use>
void for_each_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before, const Use& use) {
  if (before.size() == 0) throw std::logic_error("the bodies are placed in the first step only");
  for (BodyIndex i = 0; i < before.size(); ++i)
    if (now.removed[i] == 0) use(Vec<Dim>(now.pose[i].position - before.pose[i].position));
}

}  // namespace

template <int Dim>
double largest_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before) {
  double largest = 0.0;
  for_each_shift(now, before, [&](const Vec<Dim>& way) { largest = std::max(largest, way.norm()); });
  return largest;
}

template <int Dim>
double largest_sideways_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before) {
  double largest = 0.0;
  for_each_shift(now, before, [&](const Vec<Dim>& way) { largest = std::max(largest, horizontal<Dim>(way).norm()); });
  return largest;
}

template <int Dim>
double mean_shift(const BodyStates<Dim>& now, const BodyStates<Dim>& before) {
  double sum = 0.0;
  int count = 0;
  for_each_shift(now, before, [&](const Vec<Dim>& way) {
    sum += way.norm();
    ++count;
  });
  return count == 0 ? 0.0 : sum / count;
}

template class StageRun<2>;
template class StageRun<3>;
template struct Stage<2>;
template struct Stage<3>;
template double largest_shift(const BodyStates<2>&, const BodyStates<2>&);
template double largest_shift(const BodyStates<3>&, const BodyStates<3>&);
template double largest_sideways_shift(const BodyStates<2>&, const BodyStates<2>&);
template double largest_sideways_shift(const BodyStates<3>&, const BodyStates<3>&);
template double mean_shift(const BodyStates<2>&, const BodyStates<2>&);
template double mean_shift(const BodyStates<3>&, const BodyStates<3>&);

}  // namespace talus
