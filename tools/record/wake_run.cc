#include "tools/record/wake_run.h"

#include <fmt/format.h>

#include "common/measure/compare.h"
#include "common/measure/ensemble.h"
#include "tools/run/measured_drift.h"

namespace talus {

template <int Dim>
WorldDescription<Dim> world_at_end(const RecordedRun<Dim>& run) {
  return world_at<Dim>(run.scene, run.done, static_cast<double>(run.last_step) * run.scene.world.dt);
}

template <int Dim>
WakeTest wake(const RecordedRun<Dim>& run, double seconds, const std::string& folder) {
  if (run.backend.empty())
    throw std::invalid_argument(fmt::format("{}: no message is left that names the engine", folder));
  if (run.last.size() == 0) throw std::invalid_argument(fmt::format("{}: must hold a body", folder));
  return wake_all<Dim>(world_at_end(run), run.backend, run.last, {.duration = seconds});
}

template <int Dim>
double mean_extent(const RecordedRun<Dim>& run) {
  const std::vector<double> extents = extents_of<Dim>(run.scene.world.shapes);
  std::vector<double> all;
  for (const int shape : run.last.shape) all.push_back(extents[shape]);
  return mean(all);
}

nlohmann::ordered_json wake_json(const WakeTest& test, double extent) {
  return {{"drift_mean_D", test.mean / extent}, {"drift_p95_D", test.p95 / extent},
          {"drift_max_D", test.max / extent},   {"share_above_0.1_D", test.share_far},
          {"wake_energy_mgD", test.energy},     {"wake_energy_all_mgD", test.energy_all},
          {"creep_per_minute", test.creep}};
}

template WorldDescription<2> world_at_end(const RecordedRun<2>&);
template WorldDescription<3> world_at_end(const RecordedRun<3>&);
template WakeTest wake(const RecordedRun<2>&, double, const std::string&);
template WakeTest wake(const RecordedRun<3>&, double, const std::string&);
template double mean_extent(const RecordedRun<2>&);
template double mean_extent(const RecordedRun<3>&);

}  // namespace talus
