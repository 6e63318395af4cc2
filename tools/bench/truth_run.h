#pragma once

#include <string>
#include <vector>

#include "common/pile/pile.h"
#include "common/scene/scene.h"
#include "tools/bench/measure.h"
#include "tools/bench/truth_cell.h"

namespace talus {

/// What is measured of a run beside its shape and time.
struct TruthRunParams {
  /// Drift once all bodies are woken, and floating sleepers.
  bool last_state = true;
  /// Moments, evenly over the run, at which the awake bodies are compared with those that move; 0: none.
  int moments = 0;
  /// The run lasts as long as the scene's frames; else to calm_time() after the pour's end.
  bool to_end = false;
};

/// A run of a scene, measured.
template <int Dim>
struct TruthRun {
  Values values;
  BodyStates<Dim> last;
  std::vector<Pile<Dim>> piles;
};

/// Runs the scene without observers, so that its time is that of the simulation. A pour that has not ended after three
/// times its length and a minute is cut off. What a plan makes meaningless is not measured: drift while obstacles still
/// move, and the bodies that move in a scene with events, moving obstacles or changing gravity.
template <int Dim>
TruthRun<Dim> truth_run(const Scene<Dim>& scene, const std::string& backend, const TruthGeometry& geometry,
                        const TruthRunParams& params);

}  // namespace talus
