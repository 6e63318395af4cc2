#include "tools/record/wake_run.h"

#include <fmt/format.h>

#include "common/measure/compare.h"
#include "common/measure/ensemble.h"
#include "tools/run/backends.h"

namespace talus {

template <int Dim>
WakeTest wake(const RecordedRun<Dim>& run, double seconds, const std::string& folder) {
  if (run.backend.empty())
    throw std::invalid_argument(fmt::format("{}: no message is left that names the engine", folder));
  if (run.last.size() == 0) throw std::invalid_argument(fmt::format("{}: must hold a body", folder));
  const WorldMaker<Dim> maker = [&](const WorldDescription<Dim>& world) { return make_world<Dim>(run.backend, world); };
  WakeTestParams params;
  params.duration = seconds;
  const double time = static_cast<double>(run.last_step) * run.scene.world.dt;
  return wake_test<Dim>(maker, reference_settings(world_at<Dim>(run.scene, run.done, time)), run.last, params);
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

template WakeTest wake(const RecordedRun<2>&, double, const std::string&);
template WakeTest wake(const RecordedRun<3>&, double, const std::string&);
template double mean_extent(const RecordedRun<2>&);
template double mean_extent(const RecordedRun<3>&);

}  // namespace talus
