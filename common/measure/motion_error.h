#pragma once
// How far two runs' motions differ, body by body: section 4.2.4 of the paper, and forms of it that rank runs sensibly.

#include <span>
#include <vector>

#include "common/measure/trajectory.h"

namespace talus {

/// Differences between the motions of one frame, m in the full run and m~ in the other, over all bodies present in both
/// runs at both ends of the frame. m0 = g dt^2 with dt the length of a frame: one frame of free fall from rest.
struct MotionError {
  int bodies = 0;
  double left_out = 0.0;   // share of bodies with |m| = 0, which `relative` leaves out
  double relative = 0.0;   // the paper's: mean of |m - m~| / |m|; NaN where no body moved
  double absolute = 0.0;   // the paper's: mean of |m - m~|, in units of m0
  double floored = 0.0;    // mean of |m - m~| / max(|m|, m0)
  double ratio = 0.0;      // R: sum |m - m~| / (sum |m| + N m0)
  double symmetric = 0.0;  // S: sum |m - m~| / (sum |m| + sum |m~| + N m0), in [0, 1)
  double turning = 0.0;    // R of rotations, each body's turn times its extent D in place of m
};

/// Entry j compares the motions from frame j to j + 1. `extents` holds D [m] per shape; `gravity` in m/s^2, > 0. Throws
/// std::invalid_argument where frame times or first steps differ.
template <int Dim>
std::vector<MotionError> motion_errors(const Trajectory<Dim>& full, const Trajectory<Dim>& other,
                                       std::span<const double> extents, double gravity);

/// Means over the frames that have bodies; `relative` over those where it is defined, `left_out` by bodies.
MotionError average(std::span<const MotionError> errors);

}  // namespace talus
