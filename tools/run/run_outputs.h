#pragma once
// Everything that watches a run on behalf of `talus run`.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/measure/contact_forces.h"
#include "common/simulation/simulation.h"
#include "tools/picture/picture.h"
#include "tools/run/instrument_watch.h"
#include "tools/run/run_folder.h"
#include "tools/run/run_options.h"
#include "tools/run/run_statistics.h"

namespace talus {

/// Makes the run folder, adds the observers that `options` need, and writes what is written at the end.
template <int Dim>
class RunOutputs {
 public:
  RunOutputs(const RunOptions& options, const Scene<Dim>& scene, const std::string& scene_name,
             const std::string& backend, Simulation<Dim>& simulation);

  /// After Simulation::end(): summary.json, pile.svg and pile.png.
  void finish(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation) const;

  const std::filesystem::path& folder() const { return folder_; }
  const RunStatistics<Dim>& statistics() const { return statistics_; }
  const InstrumentWatch<Dim>& instruments() const { return instruments_; }

 private:
  void add(std::unique_ptr<Observer<Dim>> observer, Simulation<Dim>& simulation);

  std::filesystem::path folder_;
  RunStatistics<Dim> statistics_;
  InstrumentWatch<Dim> instruments_;
  ContactForces<Dim> contacts_;
  std::vector<std::unique_ptr<Observer<Dim>>> observers_;
};

/// The simulation's last state with the scene's title, for pictures; refers to all three.
template <int Dim>
PictureInput<Dim> picture_input(const SummaryInput& summary, const Scene<Dim>& scene,
                                const Simulation<Dim>& simulation);

/// The closing lines of a run on standard output; on a terminal with its pile.
template <int Dim>
void print_run(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation,
               const RunOutputs<Dim>& outputs);

}  // namespace talus
