#pragma once
// How far the sleeping bodies of a run move once all bodies are woken at its end.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/drift_probe.h"
#include "common/measure/wake_test.h"
#include "common/simulation/simulation.h"

namespace talus {

/// The displacements of the bodies that slept at the end of the run.
struct MeasuredDrift {
  std::string missing;   // why there are no numbers; empty: there are
  int bodies = 0;        // that slept
  double seconds = 0.0;  // simulated after waking
  double mean = 0.0;     // [D]
  double p95 = 0.0;      // [D]
  double max = 0.0;      // [D]
};

/// Wakes all bodies of a state and simulates on at the reference settings; `world` as world_at() gives it.
template <int Dim>
WakeTest wake_all(const WorldDescription<Dim>& world, const std::string& backend, const BodyStates<Dim>& states,
                  const WakeTestParams& params);

/// Throws std::invalid_argument where obstacles or gravity still move when the scene ends, or there is no gravity then,
/// whatever its events do. What events decide shows only at the end of the run.
template <int Dim>
void require_measurable_drift(const Scene<Dim>& scene);

/// Wakes all bodies of a copy of the last state. What still falls, moves in the copy too, but counts only by what it
/// does to the sleeping bodies. `stop` as in WakeTestParams.
template <int Dim>
MeasuredDrift measure_drift(const Simulation<Dim>& simulation, const Scene<Dim>& scene, const std::string& backend,
                            const std::function<bool()>& stop);

/// The displacements of the bodies that sleep in the tested states, ascending by index [m].
template <int Dim>
std::vector<double> of_sleepers(const WakeTest& test, const BodyStates<Dim>& states);

/// Estimates the drift at the end of a run: as measure_drift(), but shorter, and gives the simulation the result. Costs
/// at most a quarter of the `body_steps` that the run took, or 20,000 of them where that is more. None where the policy
/// has no tolerance, drift cannot be measured, no body sleeps, `stop` returns true, or the shortest probe costs more.
template <int Dim>
std::optional<DriftProbe> probe_end_drift(Simulation<Dim>& simulation, const Scene<Dim>& scene,
                                          const std::string& backend, double body_steps,
                                          const std::function<bool()>& stop);

/// A warning where the mean drift [D] of a number of bodies is above the tolerance of the policy `adaptive`.
std::optional<Warning> drift_warning(double mean, int bodies, const PolicyParams& policy, std::int64_t step);

}  // namespace talus
