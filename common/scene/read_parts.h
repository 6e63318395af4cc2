#pragma once
// The small tables of a scene file.

#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

void read_seed(TableReader& root, std::uint64_t& seed);

/// One `[[pile]]`; walls around it that are to be built are appended to the obstacles.
template <int Dim>
PileParams<Dim> read_pile(TableReader& table, std::vector<Obstacle<Dim>>& obstacles);

/// `[policy]`.
void read_policy(TableReader& table, PolicyParams& policy);

/// `[run]`; `dt` [s] is the world's.
void read_run(TableReader& table, double dt, RunParams& run);

}  // namespace talus
