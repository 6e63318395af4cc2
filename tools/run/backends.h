#pragma once
// Engines by name.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/measure/rebuild.h"
#include "common/world/engine_traits.h"
#include "common/world/world.h"

namespace talus {

/// Names of the engines in this build that can simulate `dimension`, the default first.
std::vector<std::string> backends(int dimension);

/// The engine of that name, in this build or not; an empty one: the default.
std::string backend_for(const std::string& name, int dimension);

/// What the engine of that name does badly. Throws std::invalid_argument where this build has no such engine.
template <int Dim>
EngineTraits engine_traits(std::string_view backend);

/// A new world in the engine of that name. Throws std::invalid_argument where this build has no such engine for Dim.
template <int Dim>
std::unique_ptr<World<Dim>> make_world(std::string_view backend, const WorldDescription<Dim>& description);

/// Makes worlds in the engine of that name, as make_world() does.
template <int Dim>
WorldMaker<Dim> world_maker(const std::string& backend);

}  // namespace talus
