#pragma once
// The keys of the policies.

#include <array>

#include "common/params/field.h"
#include "common/policy/paper_params.h"
#include "common/policy/rest/adaptive_params.h"

namespace talus {

inline constexpr auto adaptive_fields = std::to_array<Field<AdaptiveParams>>({
    {place_of<&AdaptiveParams::tolerance>,
     {.name = "tolerance",
      .unit = "D",
      .range = between(0.0, 10.0),
      .default_text = "by `accuracy`",
      .meaning =
          "mean distance that sleeping bodies may still move when all of them wake; a run warns where it "
          "estimates more. Below 0.05 both rest distances shrink in proportion. With `rings = 0` each region "
          "is checked for it when it comes to rest; one that moves and is steeper than its friction holds, "
          "when 10 times this share of it is unchecked. There, large: heaps come to rest too steep; small: checks "
          "take long and more is awake; 0: no checks"}},
    {place_of<&AdaptiveParams::rest_distance>,
     {.name = "rest_distance",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning = "a body is at rest while no point of it moves farther. Large: bodies that topple slowly fall "
                 "asleep on edge; small: solver noise keeps the pile awake"}},
    {place_of<&AdaptiveParams::rest_period_deep>,
     {.name = "rest_period_deep",
      .unit = "sqrt(D/g)",
      .range = between(0.0, 1e3),
      .meaning = "time at rest before sleep where the score is 1: deep in the pile, where layers are dense and the "
                 "centre is near"}},
    {place_of<&AdaptiveParams::rest_period_surface>,
     {.name = "rest_period_surface",
      .unit = "sqrt(D/g)",
      .range = between(0.0, 1e3),
      .not_below = "rest_period_deep",
      .meaning = "the same where the score is 0: at the surface and outside the pile. Short: the peak becomes too "
                 "high; long: slow"}},
    {place_of<&AdaptiveParams::rest_distance_woken>,
     {.name = "rest_distance_woken",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning = "a woken body that has moved no farther after `rest_period_woken` may sleep again. Large: slides "
                 "are stopped as they begin; small: much stays awake for nothing"}},
    {place_of<&AdaptiveParams::rest_period_woken>,
     {.name = "rest_period_woken",
      .unit = "sqrt(D/g)",
      .range = between(0.0, 1e3),
      .meaning = "that time. Short: slow slides are stopped; long: much stays awake for nothing"}},
    {place_of<&AdaptiveParams::wake_height>,
     {.name = "wake_height",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning = "only with `rings = 0`: an impact wakes a body if it would give the struck point enough speed to "
                 "rise by this height; an impact from straight above counts by a third. Low: much wakes for "
                 "nothing; high: impacts end as on rock, and the pile stays too steep"}},
    {place_of<&AdaptiveParams::heavy_impact>,
     {.name = "heavy_impact",
      .unit = "bodies",
      .range = above(0.0, 1e9),
      .meaning = "only with `rings = 0`: number of typical bodies that an impact must be able to move to wake them "
                 "before it lands. Low: each drop wakes a heap; high: a heavy fast body is stopped as by rock"}},
    {place_of<&AdaptiveParams::support_slack>,
     {.name = "support_slack",
      .unit = "D",
      .range = above(0.0, 10.0),
      .meaning = "only with `rings = 0`: how far a supporting contact may move before the supported body wakes. "
                 "Large: bodies hang in the air"}},
    {place_of<&AdaptiveParams::awake_share>,
     {.name = "awake_share",
      .range = below(1.0),
      .meaning = "part of a body's weight that awake bodies may carry when it falls asleep"}},
    {place_of<&AdaptiveParams::avalanche_width>,
     {.name = "avalanche_width",
      .unit = "D",
      .range = above(0.0, 1e3),
      .meaning = "only with `rings = 0`: width of the columns of local avalanches. Narrow: heaps do not slide as a "
                 "whole; wide: much is awake"}},
    {place_of<&AdaptiveParams::avalanche_growth>,
     {.name = "avalanche_growth",
      .range = above(1.0, 1e3),
      .meaning = "only with `rings = 0`: growth of a column's sleeping bodies, as a factor, from one check to the "
                 "next, from which the column may slide. Large: heaps become too steep; small: much wakes for "
                 "nothing; 1000: in effect never"}},
    {place_of<&AdaptiveParams::avalanche_angle>,
     {.name = "avalanche_angle_deg",
      .unit = "degrees",
      .stored = Stored::in_radians,
      .range = between(0.0, 89.0),
      .meaning = "only with `rings = 0`: slope from the top of one column to the top of the next from which bodies "
                 "may slide. Low: plains wake; high: heaps become too steep"}},
    {place_of<&AdaptiveParams::rings>,
     {.name = "rings",
      .range = between(0.0, 100.0),
      .default_text =
          "by `accuracy`; 2 in any case where an obstacle or gravity moves, events happen or loads are measured; 0 "
          "without `small_steps`",
      .meaning = "sleeping bodies up to this number of contacts from what moves take part in the contact solve, and "
                 "wake when it moves them; impacts, lost supports, avalanches and stability checks then wake none. "
                 "0: none does. 1: momentum and loads pass on too slowly; 3 and more: slow. Only with the solver "
                 "`small_steps`"}},
    {place_of<&AdaptiveParams::ring_still_speed>,
     {.name = "ring_still_speed",
      .unit = "sqrt(gD)",
      .range = above(0.0, 1.0),
      .meaning = "with `rings`: a sleeping body that the solve makes faster counts as moving. Large: heaps of low "
                 "friction stay too steep; small: much is solved for nothing"}},
});

inline constexpr auto paper_fields = std::to_array<Field<PaperParams>>({
    {place_of<&PaperParams::tau>,
     {.name = "tau", .range = below(1.0), .meaning = "sleep score to exceed. Low: bodies freeze before they rest"}},
    {place_of<&PaperParams::avalanche_density>,
     {.name = "avalanche_density",
      .range = above(0.0, 1e3),
      .meaning = "layer density above which the pile wakes; of several, bottom-up, each for a layer and the last "
                 "for all above. Must exceed what a good pile reaches"}},
    {place_of<&PaperParams::awake_steps>,
     {.name = "awake_steps",
      .range = between(0.0, 1e9),
      .meaning = "steps before a woken body may sleep again. Few: forces find no balance; many: little is saved"}},
    {place_of<&PaperParams::wake_speed>,
     {.name = "wake_speed",
      .unit = "m/s",
      .range = above(0.0, 1e6),
      .meaning = "speed at which a body of mean mass wakes a pile that it is about to hit; at 30 an ordinary drop "
                 "from 40 m does not. Low: every arrival wakes all"}},
});

}  // namespace talus
