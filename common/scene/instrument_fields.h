#pragma once
// The keys of [[gate]], [[region]] and [[load]].

#include <array>

#include "common/params/field.h"
#include "common/scene/instruments.h"

namespace talus {

/// What a load names for the ground.
inline constexpr std::string_view load_on_ground = "ground";

template <int Dim>
inline constexpr auto gate_fields = std::to_array<Field<GateParams<Dim>>>({
    {place_of<&GateParams<Dim>::name>,
     {.name = "name", .required = true, .further_rule = "of no other gate", .meaning = "in the results"}},
    {place_of<&GateParams<Dim>::corners>,
     {.name = "corners",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "in 2D the two ends of a line, in 3D three corners of a rectangle or parallelogram, the first of "
                      "them next to both others",
      .default_text = "required, in 3D without `centre`",
      .meaning = "where the gate is. Forward is, in 2D, to the right as seen from the first end towards the second: "
                 "downwards through a line from left to right; in 3D along the cross product of the sides from the "
                 "first corner to the second and to the third"}},
    {place_of<&GateParams<Dim>::centre>,
     {.name = "centre",
      .dimension = 3,
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "none",
      .meaning = "middle of a disc, in the place of `corners`"}},
    {place_of<&GateParams<Dim>::normal>,
     {.name = "normal",
      .dimension = 3,
      .type = "vector",
      .range = coordinate_range,
      .further_rule = "not zero",
      .default_text = "upwards",
      .meaning = "axis of the disc, of any length: forward is along it"}},
    {place_of<&GateParams<Dim>::radius>,
     {.name = "radius", .dimension = 3, .unit = "m", .range = length_range, .meaning = "of the disc"}},
    {place_of<&GateParams<Dim>::jam_after>,
     {.name = "jam_after",
      .unit = "sqrt(`D`/g)",
      .range = between(1.0, 1e6),
      .meaning =
          "the gate is jammed once a body has passed and then none for so long with bodies before it. Too short: "
          "gaps in a thin stream count as jams"}},
});

template <int Dim>
inline constexpr auto region_fields = std::to_array<Field<RegionParams<Dim>>>({
    {place_of<&RegionParams<Dim>::name>,
     {.name = "name", .required = true, .further_rule = "of no other region", .meaning = "in the results"}},
    {place_of<&RegionParams<Dim>::box>,
     {.name = "box",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "two corners, the lower one first; one of `box`, `centre` and `layer`",
      .default_text = "none",
      .meaning = "the region is a box"}},
    {place_of<&RegionParams<Dim>::centre>,
     {.name = "centre",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "none",
      .meaning = "the region is a ball, in 2D a disc, around this point"}},
    {place_of<&RegionParams<Dim>::radius>,
     {.name = "radius", .unit = "m", .range = length_range, .meaning = "of the ball; only with `centre`"}},
    {place_of<&RegionParams<Dim>::layer>,
     {.name = "layer",
      .type = "two numbers",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "the lower one first",
      .default_text = "none",
      .meaning = "the region is all between two heights. It has no volume, so no packing fraction"}},
});

template <int Dim>
inline constexpr auto load_fields = std::to_array<Field<LoadParams<Dim>>>({
    {place_of<&LoadParams<Dim>::name>,
     {.name = "name", .required = true, .further_rule = "of no other load", .meaning = "in the results"}},
    {{},
     {.name = "on",
      .required = true,
      .type = "text or texts",
      .further_rule = "`name` of an obstacle, or `\"ground\"`",
      .meaning = "what the force acts on: of several the sum, of a container all its walls together"}},
    {place_of<&LoadParams<Dim>::about>,
     {.name = "about",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "origin",
      .meaning = "the torque is about this point"}},
    {place_of<&LoadParams<Dim>::heights>,
     {.name = "heights",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "ascending, two or more",
      .default_text = "none",
      .meaning = "the force is also summed by the height of its contacts: between each two of these, as on the wall of "
                 "a silo"}},
});

}  // namespace talus
