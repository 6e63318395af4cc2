#pragma once
// What is allowed in a scene but will probably not give what was meant.

#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/world/engine_traits.h"

namespace talus {

/// What is allowed in a scene but will probably not give what was meant, one line each:
/// parts that do not fill their mesh, spouts that cannot keep up, sizes and masses that the engines hold badly, shapes
/// too different for one pile's layers, a policy without a pile.
template <int Dim>
std::vector<std::string> warnings(const Scene<Dim>& scene);

/// What one engine will do badly in this scene, a line each; what holds for every engine is in warnings().
template <int Dim>
std::vector<std::string> engine_warnings(const Scene<Dim>& scene, const EngineTraits& engine);

/// What the run is sure to need, from bodies that appear at once and those that the policy keeps awake.
struct Demand {
  double awake = 0.0;         // bodies awake at once, at least
  double bytes = 0.0;         // memory of all bodies
  double step_seconds = 0.0;  // processor time of a step while these are awake
};
template <int Dim>
Demand demand(const Scene<Dim>& scene, const EngineTraits& engine);

}  // namespace talus
