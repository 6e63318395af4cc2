#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "common/params/field.h"

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

inline constexpr auto paper_fields = std::to_array<Field<PaperParams>>({
    {&PaperParams::tau,
     {.name = "tau", .range = below(1.0), .meaning = "sleep score to exceed. Low: bodies freeze before they rest"}},
    {&PaperParams::avalanche_density,
     {.name = "avalanche_density",
      .range = above(0.0, 1e3),
      .meaning = "layer density above which the pile wakes; of several, bottom-up, each for a layer and the last for "
                 "all above. Must exceed what a good pile reaches"}},
    {&PaperParams::awake_steps,
     {.name = "awake_steps",
      .range = between(0.0, 1e9),
      .meaning = "steps before a woken body may sleep again. Few: forces find no balance; many: little is saved"}},
    {&PaperParams::wake_speed,
     {.name = "wake_speed",
      .unit = "m/s",
      .range = above(0.0, 1e6),
      .meaning = "speed at which a body of mean mass wakes a pile that it is about to hit; at 30 an ordinary drop from "
                 "40 m does not. Low: every arrival wakes all"}},
});

}  // namespace talus
