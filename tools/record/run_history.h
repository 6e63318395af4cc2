#pragma once
// Numbers of a recorded run over time.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/world/warning.h"
#include "tools/record/record_walk.h"

namespace talus {

/// The pile with the most room at some moment.
struct PileMoment {
  double alpha = 0.0;             // [degrees]
  std::vector<double> densities;  // of its layers, bottom-up
};

/// A slope that was fitted to the bodies.
struct MeasuredSlope {
  double time = 0.0;            // [s]
  double angle = 0.0;           // [degrees]
  double standard_error = 0.0;  // [degrees], of the fit
};

/// A value for each frame of output, unless another number is named.
struct RunHistory {
  std::vector<double> time;  // [s] simulated
  std::vector<double> awake;
  std::vector<double> asleep;
  std::vector<double> slept;           // bodies that fell asleep since the frame before
  std::vector<double> woken;           // bodies that woke since then
  std::vector<PileMoment> pile;        // without densities where there is none
  std::vector<double> drift_estimate;  // [D] expected once all are woken; NaN where the policy has no estimate
  std::vector<MeasuredSlope> slopes;   // at most 150, of the bodies of that pile that are at rest
  std::vector<Warning> warnings;       // one of each kind
  WalkResult walk;
};

/// Reads the record of a run folder. Throws std::invalid_argument where it has no frame.
template <int Dim>
RunHistory history_of(const Scene<Dim>& scene, const std::filesystem::path& folder);

/// Columns of a CSV file by their names; lines of another number of cells than the first are left out, cells that are
/// no number are NaN. Empty where the file cannot be read.
std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& csv);

}  // namespace talus
