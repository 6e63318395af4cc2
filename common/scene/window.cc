#include "common/scene/window.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "common/shape/piece.h"

namespace talus {
namespace {

std::string steps_rule(const EngineTraits& engine, const UnitScale& units = {}) {
  return fmt::format("must be at least {:g} on {}: in longer steps bodies sink into each other and into the ground",
                     engine.window.fewest_steps * units.times(), engine.name);
}

std::string iterations_rule(const EngineTraits& engine) {
  return fmt::format("must be at least {} on {}: with fewer, friction is too weak and stacks creep apart",
                     engine.window.fewest_iterations, engine.name);
}

std::string masses_rule(const EngineTraits& engine) {
  return fmt::format(
      "must be at least {} on {} where masses of bodies differ by a factor of more than {:g}: with fewer, heavy "
      "bodies sink into light ones",
      engine.window.iterations_for_masses, engine.name, engine.window.largest_mass_ratio);
}

std::string obstacle_rule(const EngineTraits& engine) {
  return fmt::format(
      "must be at most {:g} times as long as it is thick on {}: contacts with longer parts are missed; several shorter "
      "obstacles side by side are safe",
      engine.window.longest_obstacle, engine.name);
}

/// On all engines.
constexpr double tau_above = 0.0;

std::string tau_rule() {
  return fmt::format("must be above {:g} under the policy paper: else bodies fall asleep in mid-air, at rest or not",
                     tau_above);
}

/// The shapes that bodies of the scene have.
template <int Dim>
std::vector<const Shape<Dim>*> shapes_of_bodies(const Scene<Dim>& scene) {
  std::vector<bool> used(scene.world.shapes.size(), false);
  for (const InitialBody<Dim>& body : scene.bodies) used[body.def.shape] = true;
  for (const Source<Dim>& source : scene.sources)
    for (const int shape : source.shapes) used[shape] = true;
  std::vector<const Shape<Dim>*> shapes;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) shapes.push_back(&scene.world.shapes[i]);
  return shapes;
}

/// Longest side of a box, else of the bounding box [m].
template <int Dim>
double length_of(const Piece<Dim>& piece) {
  if (const auto* box = std::get_if<BoxPiece<Dim>>(&piece)) return 2.0 * box->half.maxCoeff();
  return bounds_of<Dim>(piece, Eigen::Matrix<double, Dim, Dim>::Identity(), Vec<Dim>::Zero()).sizes().maxCoeff();
}

/// Compares a scene with each limit of a window.
class WindowCheck {
 public:
  WindowCheck(const EngineTraits& engine, const std::string& file) : engine_(engine), file_(file) {}

  template <int Dim>
  void check_settings(const Scene<Dim>& scene) {
    const Window& window = engine_.window;
    const double steps = 1.0 / scene.world.dt;
    if (steps < window.fewest_steps * scene.world.units.times() * (1.0 - 1e-9))
      add("world.steps_per_second", fmt::format("{:.4g}", steps), steps_rule(engine_, scene.world.units));
    const int iterations = scene.world.solver.velocity_iterations;
    if (!scene.world.solver.small_steps() && iterations < window.fewest_iterations)
      add("world.solver.velocity_iterations", fmt::format("{}", iterations), iterations_rule(engine_));
    if (scene.policy.kind == "paper" && scene.policy.paper.tau <= tau_above)
      add("policy.tau", fmt::format("{:g}", scene.policy.paper.tau), tau_rule());
  }

  template <int Dim>
  void check_bodies(const Scene<Dim>& scene) {
    const Window& window = engine_.window;
    const std::vector<const Shape<Dim>*> shapes = shapes_of_bodies(scene);
    if (shapes.empty()) return;
    const auto [light, heavy] = std::ranges::minmax_element(shapes, {}, [](const auto* each) { return each->mass; });
    const double ratio = (*heavy)->mass / (*light)->mass;
    const int iterations = scene.world.solver.velocity_iterations;
    if (!scene.world.solver.small_steps() && ratio > window.largest_mass_ratio * (1.0 + 1e-9) &&
        iterations < window.iterations_for_masses)
      add("world.solver.velocity_iterations",
          fmt::format("{} with shape.{} of {:.3g} times the mass of shape.{}", iterations, (*heavy)->name, ratio,
                      (*light)->name),
          masses_rule(engine_));
  }

  /// The part that is longest beside its thickness.
  template <int Dim>
  void check_obstacles(const Scene<Dim>& scene) {
    double worst = engine_.window.longest_obstacle * (1.0 + 1e-9);
    std::string field;
    std::string value;
    for (const Obstacle<Dim>& obstacle : scene.world.obstacles) {
      for (const Piece<Dim>& piece : obstacle.shape.pieces) {
        const double length = length_of(piece);
        const double thickness = smallest_width(piece);
        if (length <= worst * thickness) continue;
        worst = length / thickness;
        field = obstacle.shape.name;
        value = fmt::format("{:.4g} m long and {:.3g} m thick", length, thickness);
      }
    }
    if (!value.empty()) add(field, value, obstacle_rule(engine_));
  }

  std::vector<SceneError> take() { return std::move(outside_); }

 private:
  void add(std::string field, std::string value, std::string rule) {
    outside_.push_back({file_, 0, 0, std::move(field), std::move(value), std::move(rule), {}});
  }

  const EngineTraits& engine_;
  const std::string& file_;
  std::vector<SceneError> outside_;
};

}  // namespace

std::vector<WindowRule> window_rules(const EngineTraits& engine) {
  const Window& window = engine.window;
  std::vector<WindowRule> rules = {{"world.steps_per_second", steps_rule(engine)}};
  if (window.fewest_iterations > 1) rules.push_back({"world.solver.velocity_iterations", iterations_rule(engine)});
  if (window.largest_mass_ratio < largest_mass_ratio_of_all)
    rules.push_back({"world.solver.velocity_iterations", masses_rule(engine)});
  if (std::isfinite(window.longest_obstacle)) rules.push_back({"obstacle", obstacle_rule(engine)});
  rules.push_back({"policy.tau", tau_rule()});
  return rules;
}

template <int Dim>
std::vector<SceneError> outside_window(const Scene<Dim>& scene, const EngineTraits& engine, const std::string& file) {
  WindowCheck window(engine, file);
  window.check_settings(scene);
  window.check_bodies(scene);
  window.check_obstacles(scene);
  return window.take();
}

void refuse_outside_window(std::span<const SceneError> outside) {
  if (outside.empty()) return;
  std::string text = "the scene lies outside of the window in which results hold (docs/limits.md); --force runs it";
  for (const SceneError& each : outside) text += fmt::format("\n{}", to_string(each));
  throw std::invalid_argument(text);
}

template std::vector<SceneError> outside_window(const Scene<2>&, const EngineTraits&, const std::string&);
template std::vector<SceneError> outside_window(const Scene<3>&, const EngineTraits&, const std::string&);

}  // namespace talus
