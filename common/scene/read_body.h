#pragma once
// Bodies at given places, in scene files.

#include <array>
#include <optional>

#include "common/scene/overlap.h"
#include "common/scene/read_shape.h"
#include "common/scene/scene_fields.h"
#include "common/scene/table_reader.h"

namespace talus {

/// Keys of `[[body]]`: one body, or rows and layers of bodies. body_fields has the unit, range and effect of each.
template <int Dim>
struct BodyParams {
  Vec<Dim> position = Vec<Dim>::Zero();
  double angle_step = 0.0;
  Eigen::Vector<int, Dim> repeat = Eigen::Vector<int, Dim>::Ones();
  Vec<Dim> step = Vec<Dim>::Zero();
  Vec<Dim> stagger = Vec<Dim>::Zero();
  int taper = 0;
  Vec<Dim> velocity = Vec<Dim>::Zero();
  Spin<Dim> spin = Spin<Dim>::Zero();
  bool fixed = false;
  bool asleep = false;
  std::optional<double> overlap = {};
};

template <int Dim>
inline constexpr auto body_fields = std::to_array<Field<BodyParams<Dim>>>({
    {{},
     {.name = "shape",
      .type = "text",
      .further_rule = "name of a shape",
      .default_text = "the only shape",
      .meaning = "must be given where there are several"}},
    {place_of<&BodyParams<Dim>::position>,
     {.name = "position",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "origin",
      .meaning = "where the origin of the shape's own axes goes, as for an [obstacle](#obstacles-obstacle); with "
                 "`repeat`, that of the first body. "
                 "Bodies may touch each other, obstacles and ground; overlap deeper than `overlap` is refused"}},
    {{}, angle_key},
    {{}, axis_key},
    {place_of<&BodyParams<Dim>::angle_step>,
     {.name = "angle_step_deg",
      .unit = "degrees",
      .stored = Stored::in_radians,
      .range = between(-360.0, 360.0),
      .meaning = "rotation of each body of `repeat` beyond the one before it; in 3D about `axis`"}},
    {place_of<&BodyParams<Dim>::repeat>,
     {.name = "repeat",
      .range = between(1.0, 1e4),
      .meaning =
          "bodies along each axis, from `position` on; the last number is that of layers; at most 100,000 bodies "
          "and obstacles in all"}},
    {place_of<&BodyParams<Dim>::step>,
     {.name = "step", .unit = "m", .range = coordinate_range, .meaning = "from one body to the next along each axis"}},
    {place_of<&BodyParams<Dim>::stagger>,
     {.name = "stagger",
      .unit = "m",
      .range = coordinate_range,
      .meaning = "shift of every second layer; nearly half a brick's width makes a wall in bond"}},
    {place_of<&BodyParams<Dim>::taper>,
     {.name = "taper",
      .range = between(0.0, 1e4),
      .meaning = "bodies that each layer has fewer than the one beneath, along each horizontal axis with two or more. "
                 "1: a pyramid"}},
    {place_of<&BodyParams<Dim>::velocity>,
     {.name = "velocity",
      .unit = "m/s",
      .range = speed_range,
      .further_rule = fastest_rule,
      .meaning = "of the centre of mass at the start"}},
    {place_of<&BodyParams<Dim>::spin>,
     {.name = "spin",
      .type = "vector, in 2D a number",
      .unit = "rad/s",
      .range = between(-1e4, 1e4),
      .further_rule = fastest_spin_rule,
      .meaning = "at the start, counter-clockwise"}},
    {place_of<&BodyParams<Dim>::fixed>,
     {.name = "fixed", .meaning = "true: it never moves. It is an obstacle then and counts among no bodies"}},
    {place_of<&BodyParams<Dim>::asleep>,
     {.name = "asleep",
      .meaning = "true: it sleeps from the start, and hangs in the air if nothing supports it, until something wakes "
                 "it. No effect with the policies `full` and `engine`"}},
    {place_of<&BodyParams<Dim>::overlap>,
     {.name = "overlap",
      .unit = "m",
      .range = between(0.0, 10.0),
      .default_text = "0.005, for [small bodies](#small-and-large-bodies) less",
      .meaning =
          "deepest overlap allowed; less than the default counts as that. In a pile taken from a run contacts are "
          "deeper than placed bodies may be: much overlap throws bodies apart"}},
});

/// One `[[body]]`: appends its bodies to the scene, fixed ones to the obstacles. Where
/// shapes were wrong, rules that depend on them are not checked. `placed`: all bodies before it.
template <int Dim>
void read_body(TableReader& table, const ShapeNames& shapes, OverlapCheck<Dim>& placed, Scene<Dim>& scene);

}  // namespace talus
