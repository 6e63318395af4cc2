#pragma once
// What the accuracy that a scene names sets, where the scene does not set it itself.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "common/scene/scene.h"

namespace talus {

/// One level of accuracy.
struct Accuracy {
  std::string_view name;
  /// Of a heap's shape under `adaptive`, relative to the reference, root mean square over 60 scenes (docs/accuracy.md,
  /// "Levels").
  double error;
  double step;                   // largest way of a body in one step as it reaches the ground, over its thickness
  std::array<int, 2> sub_steps;  // SolverParams::sub_steps in 2D and in 3D, where heaps are the higher the softer the
                                 // contacts are (lab/notes/small_steps.md)
  double tolerance;              // AdaptiveParams::tolerance [D]
  int rings;                     // AdaptiveParams::rings of a pour
};

inline constexpr std::array<Accuracy, 3> accuracies = {{
    {"fast", 0.2, 2.0, {4, 4}, 0.1, 0},
    {"standard", 0.07, 1.0, {usual_sub_steps, usual_sub_steps}, AdaptiveParams{}.tolerance, usual_rings},
    {"fine", 0.03, 0.5, {usual_sub_steps, 2 * usual_sub_steps}, 0.02, usual_rings},
}};
inline constexpr std::array<std::string_view, 3> accuracy_names = {accuracies[0].name, accuracies[1].name,
                                                                   accuracies[2].name};

inline constexpr double least_error = accuracies.back().error;

/// The fastest level with at most this error, from `least_error` on.
constexpr std::string_view level_within(double error) {
  return std::ranges::find_if(accuracies, [error](const Accuracy& level) { return level.error <= error; })->name;
}

/// The values of a level that a scene sets itself.
struct SetByScene {
  bool steps = false;
  bool sub_steps = false;
  bool tolerance = false;
  bool rings = false;
};

/// How bodies of a source arrive at the ground, if they fall freely from its highest place.
struct Arrival {
  double fall = 0.0;       // [m]
  double speed = 0.0;      // by energy [m/s]
  double thickness = 0.0;  // of the thinnest body [m], see thickness()

  /// Thicknesses that a body goes in a step.
  double step(double dt) const { return speed * dt / thickness; }
};

/// Of a scene that says nothing about its step; more where bodies are small.
template <int Dim>
double usual_steps_per_second(const WorldDescription<Dim>& world) {
  return world.units.steps() / WorldDescription<Dim>{}.dt;
}

template <int Dim>
Arrival arrival(const Source<Dim>& source, const WorldDescription<Dim>& world);

/// Steps a second, at least `least` (else usual_steps_per_second()), at which no body of the sources goes farther than
/// `step` times its thickness in a step as it arrives; a multiple of frames and at most eight times the least. The
/// errors of fast pours grow with this distance, whatever the solver and its passes (lab/notes/small_steps.md). Without
/// ground: the least.
template <int Dim>
double fitting_steps_per_second(const Scene<Dim>& scene, double step, std::optional<double> least = {});

/// Puts in the values of the scene's accuracy, but for those that it sets itself.
template <int Dim>
void apply_accuracy(Scene<Dim>& scene, const SetByScene& set);

/// The error of the scene's level. None if the scene has other values than its level, or a policy or solver for which
/// the levels are not calibrated.
template <int Dim>
std::optional<double> calibrated_error(const Scene<Dim>& scene);

/// Level, error, step, sub-steps, tolerance and rings of a scene, and why the step: a sentence for people.
template <int Dim>
std::string accuracy_text(const Scene<Dim>& scene);

}  // namespace talus
