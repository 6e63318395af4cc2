#include "tools/run/run_outputs.h"

#include <fmt/format.h>

#include "common/scene/write_scene.h"
#include "common/text/printable.h"
#include "tools/run/avalanches_csv.h"
#include "tools/run/frames_csv.h"
#include "tools/run/progress.h"
#include "tools/run/version.h"
#include "tools/run/warning_printer.h"
#ifdef TALUS_LCM
#include "lcmtypes/publisher.h"
#include "lcmtypes/run_recorder.h"
#endif

namespace talus {

template <int Dim>
PictureInput<Dim> picture_input(const SummaryInput& summary, const Scene<Dim>& scene,
                                const Simulation<Dim>& simulation) {
  const World<Dim>& world = simulation.world();
  const auto bodies = world.states().shape.size();
  return {scene.world.shapes,
          world.states(),
          simulation.piles().piles(),
          scene.world.obstacles,
          scene.world.ground,
          printable(scene.title),
          fmt::format("{}, policy {}: {} bodies, {} asleep", summary.backend, scene.policy.kind, bodies,
                      bodies - world.awake().size())};
}

template <int Dim>
RunOutputs<Dim>::RunOutputs(const RunOptions& options, const Scene<Dim>& scene, const std::string& scene_name,
                            const std::string& backend, Simulation<Dim>& simulation)
    : folder_(make_run_folder(options.out, fmt::format("{}-{}-{}", scene_name, backend, scene.policy.kind))),
      avalanches_(scene.world.dt) {
  write_scene(scene, folder_ / scene_file_name);
  simulation.add_observer(statistics_);
  simulation.add_observer(avalanches_);
  add(std::make_unique<FramesCsv<Dim>>(folder_ / "frames.csv"), simulation);
#ifdef TALUS_LCM
  RunInfo info = run_info(scene, scene_name, backend);
  info.version = version_text();
  add(std::make_unique<RunRecorder<Dim>>((folder_ / "run.lcm").string(), info, scene), simulation);
  if (options.telemetry) {
    const PublisherParams params{.url = options.lcm_url, .piles_rate = options.telemetry_hz};
    add(std::make_unique<Publisher<Dim>>(info, params), simulation);
  }
#endif
  add(std::make_unique<WarningPrinter<Dim>>(), simulation);
  if (!options.hash_only) add(std::make_unique<Progress<Dim>>(scene.steps()), simulation);
}

template <int Dim>
void RunOutputs<Dim>::add(std::unique_ptr<Observer<Dim>> observer, Simulation<Dim>& simulation) {
  simulation.add_observer(*observer);
  observers_.push_back(std::move(observer));
}

template <int Dim>
void RunOutputs<Dim>::finish(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation) const {
  write_summary(folder_ / "summary.json", summary, scene, simulation, statistics_);
  if (!avalanches_.records().empty()) write_avalanches(folder_ / "avalanches.csv", avalanches_.records());
  draw_pile(folder_ / "pile.svg", folder_ / "pile.png", picture_input(summary, scene, simulation));
}

template PictureInput<2> picture_input(const SummaryInput&, const Scene<2>&, const Simulation<2>&);
template PictureInput<3> picture_input(const SummaryInput&, const Scene<3>&, const Simulation<3>&);
template class RunOutputs<2>;
template class RunOutputs<3>;

}  // namespace talus
