#pragma once

#include <optional>

#include "common/pile/boundary.h"

namespace talus {

/// A pile to be built. Defaults are the paper's where it gives them.
template <int Dim>
struct PileParams {
  /// Slope [rad] in (0, pi/2). Not given: the slope that the bodies take by themselves, measured as the pile grows. Far
  /// above that slope the policy `paper` lets few bodies sleep.
  std::optional<double> alpha;

  /// Whether the policy `adaptive` holds the pile at `alpha`, which must then be given, where that is steeper than the
  /// bodies' own slope. It damps bodies for that; the pile sinks once it is woken as a whole.
  bool control_slope = false;

  /// Middle of the base [m]. Not given: where the first body lands (section 3.1).
  std::optional<Vec<Dim>> at;

  /// N at the start, >= 1. Larger: the first bodies wait longer for a dense layer.
  double initial_size = 8.0;

  /// Occupation ratio in (0, 1] above which N doubles (section 3.2).
  double growth_ratio = 0.5;

  /// Piles of one kind merge when their centres stay nearer than this [D], >= 0. 0: never.
  double merge_distance = 1.0;

  /// Walls around `at`, which must then be given; such a pile does not drift.
  std::optional<Boundary<Dim>> boundary = {};

  /// Whether bodies that have touched nothing yet count. Not given: no with `adaptive`, yes otherwise (section 3.2
  /// counts all). If they count, a stream of bodies fills the top layer.
  std::optional<bool> count_flying = {};

  /// Part of the way to the bodies' mean that the centre goes per second [1/s], >= 0.
  double drift_rate = 0.5;
};

}  // namespace talus
