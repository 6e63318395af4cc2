#pragma once
// Were the sleepers right to sleep? Wake them all and see whether the pile moves.

#include <functional>
#include <vector>

#include "common/measure/rebuild.h"

namespace talus {

/// For how long a pile is simulated after waking: 5 s at 9.81 m/s^2, in other gravity [m/s^2] as long as takes the same
/// motion there [s].
double wake_time(double gravity);

struct WakeTestParams {
  double duration = 5.0;       // [s] > 0 simulated after waking; short: slow topples are not seen to the end
  double energy_window = 0.5;  // [s] > 0 in which the wake energy is measured
  /// Called before each step; where it returns true the test ends there, and its result means nothing. Empty: never.
  std::function<bool()> stop = {};
};

/// Motion of a pile after all of its bodies were woken.
struct WakeTest {
  int bodies = 0;
  double mean = 0.0;                  // displacement over all bodies [m]
  double p95 = 0.0;                   // [m]
  double max = 0.0;                   // [m]
  double energy = 0.0;                // largest kinetic energy of one body over its m g D, in the window
  double energy_all = 0.0;            // largest sum of all kinetic energies over the sum of m g D, in the window
  double creep = 0.0;                 // height lost by the centre of mass per minute / its height above the ground
  std::vector<double> displacements;  // of the bodies not removed, ascending by index [m]
};

/// Rebuilds `states` in a fresh world with all bodies awake and simulates on. `description` holds the settings to judge
/// by, as judging_settings() gives them. The state should be a finished pile: what still falls counts as displaced.
template <int Dim>
WakeTest wake_test(const WorldMaker<Dim>& make_world, const WorldDescription<Dim>& description,
                   const BodyStates<Dim>& states, const WakeTestParams& params = {});

}  // namespace talus
