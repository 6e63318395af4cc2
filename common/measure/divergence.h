#pragma once
// When chaos has taken two runs apart, and how to read a measure against it.

#include <span>
#include <vector>

#include "common/measure/trajectory.h"

namespace talus {

/// Throws std::invalid_argument unless frames of the two trajectories fall on the same times.
template <int Dim>
void check_comparable(const Trajectory<Dim>& a, const Trajectory<Dim>& b);

/// Mean distance [m] between a body's places in the two runs, per frame; 0 for frames without bodies.
template <int Dim>
std::vector<double> position_differences(const Trajectory<Dim>& a, const Trajectory<Dim>& b);

/// First frame at which a floor pair (a full run and the same run moved by a micrometre) exceeds half its final value,
/// the mean over the last tenth of the series. Made for position_differences(), which keeps its value when a pile comes
/// to rest. Frames before it mean little: there any two runs agree. The length of the series where it is 0 throughout.
int divergence_frame(std::span<const double> floor_pair);

/// Where a value of R or S lies between the floor (a full run against itself moved by a micrometre: 0) and the ceiling
/// (against unrelated drops: 1). Throws std::invalid_argument unless ceiling > floor.
double skill(double value, double floor, double ceiling);

}  // namespace talus
