#pragma once
// A world of small or large bodies, simulated in units that suit the engine.

#include <memory>

#include "common/world/world.h"

namespace talus {

/// The scale at which the narrowest body is about 1 m wide, for worlds whose narrowest body is narrower than 0.1 m or
/// has a part too thin for an engine, or is wider than 10 m; else 1.
template <int Dim>
UnitScale fitting_units(const WorldDescription<Dim>& description);

/// The same world in the units of its engine, WorldDescription::units being 1 there.
template <int Dim>
WorldDescription<Dim> in_engine_units(const WorldDescription<Dim>& description);

/// What `make` makes of the description: as it is, or in the units of the engine behind a world in those of the
/// description.
template <int Dim>
std::unique_ptr<World<Dim>> make_in_engine_units(const WorldDescription<Dim>& description, const WorldMaker<Dim>& make);

}  // namespace talus
