#pragma once
// The keys of a pile.

#include <array>

#include "common/params/field.h"
#include "common/pile/pile_params.h"

namespace talus {

template <int Dim>
inline constexpr auto pile_fields = std::to_array<Field<PileParams<Dim>>>({
    {place_of<&PileParams<Dim>::alpha>,
     {.name = "alpha_deg",
      .unit = "degrees",
      .stored = Stored::in_radians,
      .range = between(1.0, 89.0),  // at 0 and 90 a pile has no height or no base
      .default_text = "[angle of repose](extending.md#glossary) of the bodies",
      .meaning = "slope of the cone, in 2D of the wedge; within walls it must be given. Far above the angle of repose "
                 "`paper` lets few bodies sleep"}},
    {place_of<&PileParams<Dim>::control_slope>,
     {.name = "control_slope",
      .meaning =
          "whether raised friction and attraction of its bodies hold the pile at `alpha_deg`, which must then be "
          "given, where that is steeper than the angle of repose ([how](method.md#slope-control)). Not within walls; "
          "without effect with the engines' own solvers"}},
    {place_of<&PileParams<Dim>::at>,
     {.name = "at",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "where the first body lands",
      .meaning = "middle of the base"}},
    {place_of<&PileParams<Dim>::initial_size>,
     {.name = "initial_size",
      .range = between(1.0, 1e7),
      .meaning = "number of bodies, [`N`](extending.md#glossary), for which the layers have room at the start. Larger: "
                 "the first "
                 "bodies wait longer for a dense layer"}},
    {place_of<&PileParams<Dim>::growth_ratio>,
     {.name = "growth_ratio",
      .range = between(0.01, 1.0),
      .meaning = "[occupation ratio](extending.md#glossary) above which `N` doubles"}},
    {place_of<&PileParams<Dim>::merge_distance>,
     {.name = "merge_distance",
      .unit = "D",
      .range = between(0.0, 1e6),
      .meaning = "piles of one slope whose centres stay nearer than this become one; 0: never"}},
    {place_of<&PileParams<Dim>::drift_rate>,
     {.name = "drift_rate",
      .unit = "1/s",
      .range = between(0.0, 1e3),
      .default_text = "0.5, for [small bodies](#small-and-large-bodies) more",
      .meaning = "share of the way to its bodies' mean position that the centre goes per second. High: layers change "
                 "while bodies sleep by them"}},
    {place_of<&PileParams<Dim>::count_flying>,
     {.name = "count_flying",
      .default_text = "false with `adaptive`, else true",
      .meaning =
          "whether bodies that have touched nothing yet count in a layer. true: a stream of bodies fills the top "
          "layer and may start an avalanche"}},
    {{},
     {.name = "boundary", .type = "table", .default_text = "none", .meaning = "walls around `at`: `[pile.boundary]`"}},
});

}  // namespace talus
