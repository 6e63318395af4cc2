#pragma once
// The present state of a run as a scene file.

#include <string>

#include "common/simulation/simulation.h"

namespace talus {

/// A scene file that begins where the simulation is: its bodies as placed ones with their velocities, what the sources
/// have still to drop, obstacles and gravity as they are, events that have not happened. What it does not keep stands
/// in its first lines. `scene` must have been read from TOML. Throws std::invalid_argument where a scene file cannot
/// say it.
template <int Dim>
std::string saved_scene(const Scene<Dim>& scene, const Simulation<Dim>& simulation);

}  // namespace talus
