#pragma once

#include <functional>

#include "common/simulation/simulation.h"
#include "tools/run/run_folder.h"
#include "tools/run/run_options.h"
#include "tools/run/run_outputs.h"

namespace talus {

/// What follows the last step of a run that leaves a folder: its drift is estimated and, where the options say so,
/// measured, which ends once `stop` says so; observers hear the end, and the folder is completed. `summary` has what is
/// known so far, and gets the rest.
template <int Dim>
void finish_run(const RunOptions& options, const Scene<Dim>& scene, Simulation<Dim>& simulation,
                const RunOutputs<Dim>& outputs, const std::function<bool()>& stop, SummaryInput& summary);

}  // namespace talus
