#pragma once
// `talus bench published`: published experiments, their numbers beside ours.

#include "tools/bench/bench_plan.h"

namespace talus {

/// What stands in the place of a scene to mean all of scenes/published, or those that are named after it.
inline constexpr std::string_view published_word = "published";

/// Runs the experiments and writes published.md, a table for each, and runs.csv into the folder of `given`. Returns
/// the exit code. Throws std::invalid_argument and SceneErrors where a run is not possible.
int bench_published(const BenchOptions& given);

}  // namespace talus
