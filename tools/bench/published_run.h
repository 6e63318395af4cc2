#pragma once
// One run of a published experiment.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/bench/bench_run.h"

namespace talus {

/// Runs a case and leaves its summary.json, and its gates.csv and such, in `folder`. Returns that summary with an
/// object `end` more:
/// - `slope_deg`: slope of a heap on a table around x = 0, mean of both flanks. A line through the highest centres in
///   columns a body wide, from 15 to 85 % of the way to its edge (as Zhou et al. 2002).
/// - `tilt_deg`: angle between straight down and the line from the origin to the centre of mass, positive to the side
/// of
///   x, mean over the second half of the run.
/// - `rank_of_first`: share of the other bodies whose centre is lower than that of body 0.
nlohmann::json published_run(const BenchCase& bench_case, const std::filesystem::path& folder);

}  // namespace talus
