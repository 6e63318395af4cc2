#pragma once

#include <optional>

#include "common/pile/boundary.h"

namespace talus {

/// A pile to be built. Defaults are the paper's where it gives them. pile_fields has the unit, range and effect of all
/// fields except `boundary`.
template <int Dim>
struct PileParams {
  std::optional<double> alpha;
  bool control_slope = false;
  std::optional<Vec<Dim>> at;
  double initial_size = 8.0;
  double growth_ratio = 0.5;
  double merge_distance = 1.0;
  /// Walls around `at`, which must then be given; such a pile does not drift.
  std::optional<Boundary<Dim>> boundary = {};
  std::optional<bool> count_flying = {};
  double drift_rate = 0.5;
};

}  // namespace talus
