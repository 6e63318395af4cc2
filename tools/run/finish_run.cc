#include "tools/run/finish_run.h"

#include <fmt/format.h>

#include "common/scene/happened.h"
#include "tools/output/output.h"
#include "tools/run/measured_drift.h"

namespace talus {
namespace {

/// What --measure-drift adds to the summary of a run that has ended.
template <int Dim>
void add_measured_drift(SummaryInput& summary, const Scene<Dim>& scene, const Simulation<Dim>& simulation,
                        const std::function<bool()>& stop) {
  if (summary.reason != "finished") {
    summary.measured = MeasuredDrift{.missing = "the run did not finish"};
    return;
  }
  try {
    summary.measured = measure_drift<Dim>(simulation, scene, summary.backend, stop);
  } catch (const std::exception& error) {  // of the copy: the run itself is whole
    summary.measured = MeasuredDrift{.missing = error.what()};
  }
}

/// What a run under `adaptive` tells of its error by itself once its last step is done. Before end(), so that its
/// observers, and so record and messages, have the same number as the summary.
template <int Dim>
void add_probed_drift(const RunOptions& options, SummaryInput& summary, const Scene<Dim>& scene,
                      Simulation<Dim>& simulation, const RunStatistics<Dim>& statistics,
                      const std::function<bool()>& stop) {
  if (summary.reason != "finished") return;
  const double body_steps = statistics.mean_awake() * static_cast<double>(statistics.steps());
  try {
    summary.probe = probe_end_drift<Dim>(simulation, scene, summary.backend, body_steps, stop);
  } catch (const std::exception& error) {  // of the copy: the run itself is whole
    summary.scene_warnings.push_back(fmt::format("no drift probe: {}", error.what()));
    if (!options.quiet) print_message("warning: {}", summary.scene_warnings.back());
  }
}

/// A warning of a drift above the tolerance: as measured, else as far as the probe has seen it.
template <int Dim>
void add_drift_warning(const RunOptions& options, SummaryInput& summary, const Scene<Dim>& scene,
                       const Simulation<Dim>& simulation) {
  const bool measured = summary.measured && summary.measured->missing.empty();
  if (!measured && !summary.probe) return;
  const auto warning =
      drift_warning(measured ? summary.measured->mean : summary.probe->least,
                    measured ? summary.measured->bodies : summary.probe->bodies,
                    policy_at(scene, simulation.done_events(), simulation.time()), simulation.frame().step);
  if (!warning) return;
  if (!options.quiet) print_message("warning: {}", advice(*warning));
  summary.warnings.push_back(*warning);
}

}  // namespace

template <int Dim>
void finish_run(const RunOptions& options, const Scene<Dim>& scene, Simulation<Dim>& simulation,
                const RunStatistics<Dim>& statistics, const std::function<bool()>& stop, SummaryInput& summary) {
  if (options.probe_drift) add_probed_drift(options, summary, scene, simulation, statistics, stop);
  simulation.end(summary.reason);
  summary.warnings.assign(simulation.warnings().begin(), simulation.warnings().end());
  if (options.measure_drift) add_measured_drift(summary, scene, simulation, stop);
  add_drift_warning(options, summary, scene, simulation);
}

template void finish_run(const RunOptions&, const Scene<2>&, Simulation<2>&, const RunStatistics<2>&,
                         const std::function<bool()>&, SummaryInput&);
template void finish_run(const RunOptions&, const Scene<3>&, Simulation<3>&, const RunStatistics<3>&,
                         const std::function<bool()>&, SummaryInput&);

}  // namespace talus
