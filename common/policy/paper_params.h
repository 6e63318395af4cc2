#pragma once

#include <algorithm>
#include <vector>

namespace talus {

/// Constants of sections 3.3 and 3.4; the paper's values where it gives them.
struct PaperParams {
  double tau = 0.5;  // sleep score to exceed, in [0, 1); low: bodies freeze before they rest
  std::vector<double> avalanche_density = {0.8};  // layer densities that wake the pile, > 0, bottom-up; the last holds
                                                  // for all layers above. Must exceed what a good pile reaches
  int awake_steps = 30;      // steps before a woken body may sleep again, >= 0 ("several timesteps"); few: forces
                             // find no balance, many: little is saved
  double wake_speed = 30.0;  // [m/s] > 0: momentum that wakes a pile it arrives at, over the typical body's mass; at
                             // 30 an ordinary drop from 40 m does not. Low: every arrival wakes all

  /// Density above which layer number `layer` starts an avalanche.
  double avalanche_density_of(std::size_t layer) const {
    return avalanche_density[std::min(layer, avalanche_density.size() - 1)];
  }
};

}  // namespace talus
