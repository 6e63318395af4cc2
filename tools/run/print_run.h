#pragma once

#include "common/simulation/simulation.h"
#include "tools/run/run_outputs.h"

namespace talus {

/// The closing lines of a run on standard output; on a terminal with its pile.
template <int Dim>
void print_run(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation,
               const RunOutputs<Dim>& outputs);

}  // namespace talus
