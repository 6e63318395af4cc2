#pragma once
// All measures that compare two runs, in one plain struct for tools to print.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "common/measure/distributions.h"
#include "common/measure/motion_error.h"
#include "common/measure/shape_statistics.h"

namespace talus {

/// The first frame at which two runs are not the same bit for bit.
struct FirstDifference {
  std::int64_t step = 0;  // of the first frame that differs, in the first run
  BodyIndex body = 0;     // the lowest that differs
};

/// Nothing if all frames that both runs have are equal.
template <int Dim>
std::optional<FirstDifference> first_difference(const Trajectory<Dim>& a, const Trajectory<Dim>& b);

/// The last frame that is known in both runs, or -1.
template <int Dim>
int last_common_frame(const Trajectory<Dim>& a, const Trajectory<Dim>& b);

/// `a` in the role of the full run. States are compared at last_common_frame().
template <int Dim>
struct RunComparison {
  int frames = 0;    // that both runs have, lost ones included
  int last = 0;      // last_common_frame()
  int left_out = 0;  // frames of these that are lost in either run
  std::optional<FirstDifference> first_difference;
  std::vector<MotionError> motion;    // per frame
  MotionError motion_mean;            // over all frames
  std::vector<double> position_mean;  // per frame, over D
  double position_p95 = 0.0;          // at the last frame, over D
  double position_max = 0.0;          // of the farthest body
  ShapeStatistics<Dim> shape_a;
  ShapeStatistics<Dim> shape_b;
  double profile_rms = 0.0;  // difference of the height profiles over D
  DistributionDistance z;    // of bodies' heights [m]; one run a side has no p
  DistributionDistance r;    // of bodies' distances from the grid's centre [m]
};

/// `shapes` and `gravity` [m/s^2] are those of both runs' worlds; D is the mean over `shapes`' bodies in `a`; bodies
/// faster than `fastest` [m/s] are no part of the shapes. Throws std::invalid_argument where the runs' frames do not
/// fall on the same times or they have none in common.
template <int Dim>
RunComparison<Dim> compare_runs(const Trajectory<Dim>& a, const Trajectory<Dim>& b, std::span<const Shape<Dim>> shapes,
                                double gravity, const ProfileGrid<Dim>& grid,
                                double fastest = std::numeric_limits<double>::infinity());

/// D [m] of each shape, as the measures take it.
template <int Dim>
std::vector<double> extents_of(std::span<const Shape<Dim>> shapes);

}  // namespace talus
