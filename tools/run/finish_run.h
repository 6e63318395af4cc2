#pragma once

#include <functional>

#include "common/simulation/simulation.h"
#include "tools/run/run_folder.h"
#include "tools/run/run_options.h"
#include "tools/run/run_statistics.h"

namespace talus {

/// What follows the last step of a run: its drift is estimated and, where the options say so, measured, which ends once
/// `stop` says so; and observers hear the end. `summary` has what is known so far, and gets the rest.
template <int Dim>
void finish_run(const RunOptions& options, const Scene<Dim>& scene, Simulation<Dim>& simulation,
                const RunStatistics<Dim>& statistics, const std::function<bool()>& stop, SummaryInput& summary);

}  // namespace talus
