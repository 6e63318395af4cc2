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
/// - `surface_deg`: slope of the surface in the first region, mean over the frames of the second half of the run; null
///   without a region.
/// - `janssen`: column_numbers() by their names; null where there are none.
/// - `rank_of_first`: share of the other bodies whose centre is lower than that of body 0.
nlohmann::json published_run(const BenchCase& bench_case, const std::filesystem::path& folder);

}  // namespace talus
