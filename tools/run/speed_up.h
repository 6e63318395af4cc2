#pragma once
// How many times faster a scene runs under one policy than under another.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace talus {

/// How long rounds are repeated.
struct SpeedUpParams {
  int least_rounds = 3;        // >= 1. Fewer than three have no median that a disturbed round leaves alone
  int most_rounds = 99;        // >= least_rounds
  double most_seconds = 10.0;  // of wall time, after which no round beyond the least begins
};

/// Mean processor time of a step on the calling thread: one value for each round.
struct SpeedUp {
  std::vector<double> own;    // of the scene under its own policy [s]
  std::vector<double> other;  // under the policy that it is compared with [s]
  std::vector<double> ratios() const;
};

/// Runs both scenes in each round, in turn first, without recording. Throws NonFiniteState where a run fails.
template <int Dim>
SpeedUp measure_speed_up(const Scene<Dim>& own, const Scene<Dim>& other, const std::string& backend,
                         const SpeedUpParams& params = {});

/// Measures and prints median and range of the ratio; returns the exit code. A signal ends the command at once: the
/// recorded run is complete by then.
template <int Dim>
int tell_speed_up(const Scene<Dim>& own, const Scene<Dim>& other, const std::string& backend);

}  // namespace talus
