#pragma once

#include <string>

#include "common/simulation/simulation.h"

namespace talus {

/// The scene on the engine of that name, as `talus run` simulates and `talus check` checks it. Throws
/// std::invalid_argument where the engine cannot run it or its bodies do not fit into the machine's memory.
template <int Dim>
Simulation<Dim> make_simulation(const Scene<Dim>& scene, const std::string& backend);

}  // namespace talus
