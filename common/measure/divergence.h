#pragma once
// How far chaos has taken two runs apart.

#include <vector>

#include "common/measure/trajectory.h"

namespace talus {

/// Throws std::invalid_argument unless frames of the two trajectories fall on the same times.
template <int Dim>
void check_comparable(const Trajectory<Dim>& a, const Trajectory<Dim>& b);

/// Mean distance [m] between a body's places in the two runs, per frame; 0 for frames without bodies.
template <int Dim>
std::vector<double> position_differences(const Trajectory<Dim>& a, const Trajectory<Dim>& b);

}  // namespace talus
