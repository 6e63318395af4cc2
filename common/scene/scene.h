#pragma once
// A scene as plain structs: what a TOML scene file says, in SI units and radians.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/pile/pile_params.h"
#include "common/policy/adaptive/adaptive_params.h"
#include "common/policy/paper_params.h"
#include "common/world/world_description.h"

namespace talus {

/// Drops bodies. A body is emitted only where its place is free: else it waits, and with it all after it.
template <int Dim>
struct Source {
  std::vector<int> shapes = {0};  // indices of WorldDescription::shapes, dropped in turn; not empty
  int count = 400;                // bodies in all, >= 1
  double start = 0.0;             // [s] >= 0, when the first is due
  double rate = 6.6;              // [1/s] > 0; a rate that the spout cannot reach only makes bodies wait
  Vec<Dim> position = Vec<Dim>::Unit(Dim - 1) * 10.0;  // [m], middle of where bodies appear
  // Bodies that appear at once, in rows along each axis, the lowest at the height of `position`. A grid of n is dropped
  // as a whole, the next one n / rate later. [1, 1, 1]: one body at a time.
  Eigen::Matrix<int, Dim, 1> grid = Eigen::Matrix<int, Dim, 1>::Ones();
  Vec<Dim> spacing = Vec<Dim>::Zero();  // [m] >= 0, between rows, from middle to middle
  // [m] >= 0, uniform to both sides of `position` on each axis. The scene reader's default is default_spread().
  Vec<Dim> spread = Vec<Dim>::Zero();
  Vec<Dim> velocity = Vec<Dim>::Zero();           // [m/s]
  Vec<Dim> velocity_spread = Vec<Dim>::Zero();    // [m/s] >= 0, uniform to both sides
  std::optional<Rotation<Dim>> orientation = {};  // not given: uniformly random
  double spin_spread = 0.0;                       // [rad/s] >= 0, uniform on each axis
  Vec<Dim> sweep = Vec<Dim>::Zero();  // [m]: the spout moves to and fro between position - sweep and position + sweep
  double sweep_period = 0.0;          // [s] >= 0, there and back; 0: it stands still
  double ride_above = 0.0;  // [m] >= 0: the spout rises so as to stay this far above what lies beneath; 0: it does not

  int bodies_at_once() const { return grid.prod(); }
  /// When the body of this number is due, from 0 on [s].
  double due_time(int number) const {
    const int before_its_grid = number - number % bodies_at_once();
    return start + before_its_grid / rate;
  }
  /// Bodies that are due by `time` [s], up to `count`.
  int due_by(double time) const;
  /// From the middle of the grid's first row to that of its last, along each axis [m].
  Vec<Dim> grid_extent() const { return ((grid.array() - 1).template cast<double>() * spacing.array()).matrix(); }
};

/// Policy by name with its parameters.
struct PolicyParams {
  std::string kind = "adaptive";  // full, engine, paper, adaptive
  PaperParams paper;
  AdaptiveParams adaptive;
};

/// Length of a run. Output comes in frames of one or more steps.
struct RunParams {
  std::int64_t frames = 300;  // >= 1
  double frame_rate = 30.0;   // [1/s] > 0; 1 / (frame_rate dt) must be a whole number of steps
};

template <int Dim>
struct Scene {
  std::string title;  // one line, what `talus list` shows
  WorldDescription<Dim> world;
  std::vector<Source<Dim>> sources;
  std::vector<PileParams<Dim>> piles;
  PolicyParams policy;
  RunParams run;
  std::uint64_t seed = 1;
  std::string toml;  // the file it was read from, `--set` values put in; empty for a scene made by a program
  std::filesystem::path folder;                 // of that file
  std::vector<std::filesystem::path> referred;  // files in or below it that `toml` names, relative to it
  std::vector<std::string> reader_warnings;     // of keys under an old name and of parts that do not fill their mesh

  /// Steps of dt in one frame of output.
  std::int64_t steps_per_frame() const;
  std::int64_t steps() const { return run.frames * steps_per_frame(); }
};

}  // namespace talus
