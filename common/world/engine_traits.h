#pragma once
// What an engine does badly or not at all, as measured; docs/scenes.md says how.

#include <limits>
#include <string_view>

namespace talus {

/// Largest ratio of masses of two bodies that check(WorldDescription) allows: beyond it a heavy body sinks through
/// light ones in the engines' own solvers, at any number of iterations.
inline constexpr double largest_mass_ratio_of_all = 100.0;

/// The window in which an engine's results hold, from the runs of `talus stress` (docs/limits.md). Outside of it
/// structures that stand by statics fall apart or bodies pass through each other. outside_window() applies it.
struct Window {
  /// Steps a second, at least [1/s].
  double fewest_steps = 30.0;
  /// world.solver.velocity_iterations, at least.
  int fewest_iterations = 1;
  /// Largest over smallest mass of bodies with fewer than `iterations_for_masses`.
  double largest_mass_ratio = largest_mass_ratio_of_all;
  int iterations_for_masses = 50;
  /// Longest side of an obstacle's part over its smallest width, at most.
  double longest_obstacle = std::numeric_limits<double>::infinity();
};

struct EngineTraits {
  std::string_view name;
  Window window = {};
  double fastest_step = std::numeric_limits<double>::infinity();  // [m] a step: faster bodies are slowed down to it
  // Fall within one step, g dt^2, over the thinnest piece of a shape, above which bodies sink into the ground.
  double sinking_fall = std::numeric_limits<double>::infinity();
  double awake_bytes = 0.0;    // memory of one awake body in a heap
  double sleeper_bytes = 0.0;  // memory of one sleeping body
  double awake_seconds = 0.0;  // processor time of a step for one awake body in a heap
};

}  // namespace talus
