#pragma once

#include <string>

#include "common/scene/scene.h"

namespace talus {

/// What freezing a whole pile for a second and waking it does, beside the same pile never frozen.
struct WakingShock {
  double speed = 0.0;        // largest mean speed of the bodies in the two seconds after waking [m/s]
  double drift = 0.0;        // mean displacement in that time [m]
  double speed_never = 0.0;  // the same in the same two seconds of a run without sleeping
  double drift_never = 0.0;
};

/// Runs the scene in full, twice; in one run all bodies are frozen at its end for a second.
template <int Dim>
WakingShock waking_shock(const Scene<Dim>& scene, const std::string& backend);

}  // namespace talus
