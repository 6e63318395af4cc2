#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/diagnostics.h"
#include "common/simulation/simulation.h"

namespace talus {

/// The scene on the engine of that name, as `talus run` simulates and `talus check` checks it. Throws
/// std::invalid_argument where the engine cannot run it or its bodies do not fit into the machine's memory.
template <int Dim>
Simulation<Dim> make_simulation(const Scene<Dim>& scene, const std::string& backend);

/// What of the scene lies outside of the window in which the engine's results hold. Throws std::invalid_argument where
/// anything does, unless `force` is given. `file`: of the scene, for the messages.
template <int Dim>
std::vector<SceneError> check_window(const Scene<Dim>& scene, const std::string& backend,
                                     const std::filesystem::path& file, bool force);

/// All other warnings about the scene and how the engine holds it, a line each.
template <int Dim>
std::vector<std::string> scene_warnings(const Scene<Dim>& scene, const std::string& backend);

/// Prints both kinds, as `talus run` and `talus check` do.
void print_scene_warnings(const std::vector<SceneError>& outside, const std::vector<std::string>& warnings);

/// What a warning of a scene outside of the window begins with.
inline constexpr std::string_view outside_prefix = "outside of the window in which results hold: ";

}  // namespace talus
