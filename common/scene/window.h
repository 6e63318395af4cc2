#pragma once
// Whether a scene lies in the window in which an engine's results hold.

#include <span>
#include <string>
#include <vector>

#include "common/scene/diagnostics.h"
#include "common/scene/scene.h"
#include "common/world/engine_traits.h"

namespace talus {

/// One limit of an engine's window.
struct WindowRule {
  std::string field;  // of a scene, as `shape.*`
  std::string rule;   // "must be ...", and what happens outside
};

/// The limits that the engine has, for the manual: the same sentences as in outside_window().
std::vector<WindowRule> window_rules(const EngineTraits& engine);

/// What of the scene lies outside of the engine's window; empty: nothing. `file`: of the scene, for the messages.
template <int Dim>
std::vector<SceneError> outside_window(const Scene<Dim>& scene, const EngineTraits& engine, const std::string& file);

/// Throws std::invalid_argument with a line for each entry, and the way out; does nothing where there is none.
void refuse_outside_window(std::span<const SceneError> outside);

}  // namespace talus
