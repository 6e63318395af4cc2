#pragma once
// The folder that a run leaves behind.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/diagnostics.h"
#include "common/simulation/simulation.h"
#include "tools/run/instrument_watch.h"
#include "tools/run/measured_drift.h"
#include "tools/run/run_options.h"
#include "tools/run/run_statistics.h"

namespace talus {

/// A folder for one run, with an empty scene file: `wanted`, or where that is empty the first free one of runs/NAME,
/// runs/NAME-2, ... Runs that start at the same time get different folders. Throws std::invalid_argument where `wanted`
/// exists and is not empty (nothing is ever overwritten), and where the folder cannot be made.
std::filesystem::path make_run_folder(const std::filesystem::path& wanted, const std::string& name);

/// What summary.json holds beyond the statistics.
struct SummaryInput {
  std::string scene_name;
  std::string backend;
  std::string reason;                            // "finished", "interrupted", or what went wrong
  double wall_seconds = 0.0;                     // from the first step to the last, observers included
  std::int64_t emit_waits = 0;                   // steps at which a due body found no room
  double pixels_per_metre = 0.0;                 // of pile.png
  std::vector<SceneError> outside_window = {};   // what of the scene lies outside of the engine's window
  std::vector<std::string> scene_warnings = {};  // scene_warnings() of make_simulation.h
  std::optional<MeasuredDrift> measured = {};    // none: without --measure-drift
  std::optional<DriftProbe> probe = {};          // none: not made, or without a result
  std::vector<Warning> warnings = {};            // of the run and of what was measured after it
};

/// Writes summary.json.
template <int Dim>
void write_summary(const std::filesystem::path& file, const SummaryInput& input, const Scene<Dim>& scene,
                   const Simulation<Dim>& simulation, const RunStatistics<Dim>& statistics,
                   const InstrumentWatch<Dim>& instruments);

}  // namespace talus
