#pragma once

#include <algorithm>
#include <vector>

namespace talus {

/// Constants of sections 3.3 and 3.4; the paper's values where it gives them. paper_fields has the unit, range and
/// effect of each.
struct PaperParams {
  double tau = 0.5;
  std::vector<double> avalanche_density = {0.8};
  int awake_steps = 30;  // "several timesteps"
  double wake_speed = 30.0;

  /// Density above which layer number `layer` starts an avalanche.
  double avalanche_density_of(std::size_t layer) const {
    return avalanche_density[std::min(layer, avalanche_density.size() - 1)];
  }
};

}  // namespace talus
