#pragma once
// How an obstacle moves by plan, in scene files.

#include <array>

#include "common/scene/read_shape.h"
#include "common/scene/scene_fields.h"
#include "common/scene/table_reader.h"
#include "common/world/motion.h"

namespace talus {

inline constexpr std::array<std::string_view, 4> motion_kinds = {"sine", "turn", "path", "belt"};
inline constexpr std::span<const std::string_view> gravity_motion_kinds = std::span(motion_kinds).first(3);
constexpr Key kind_of_motion(std::span<const std::string_view> kinds) {
  return {.name = "kind",
          .required = true,
          .type = "text",
          .choices = kinds,
          .meaning = "decides which of the keys below belong here"};
}
inline constexpr Key motion_kind_key = kind_of_motion(motion_kinds);
inline constexpr Key gravity_motion_kind_key = kind_of_motion(gravity_motion_kinds);
constexpr Key axis_of_turn(std::string_view meaning) {
  return {.name = "axis",
          .dimension = 3,
          .type = "vector",
          .range = coordinate_range,
          .further_rule = "not zero",
          .default_text = "required for a turn",
          .meaning = meaning};
}
inline constexpr Key motion_axis_key =
    axis_of_turn("axis of the turn through the obstacle's `position`, of any length");
inline constexpr Key gravity_motion_axis_key = axis_of_turn("axis of the turn, of any length");
inline constexpr Range time_range = between(0.0, 1e6);

template <int Dim>
inline constexpr Field<Motion<Dim>> motion_start_field = {
    place_of<&Motion<Dim>::start>,
    {.name = "start", .unit = "s", .range = time_range, .meaning = "until then it stays as it is"}};
template <int Dim>
inline constexpr Field<Motion<Dim>> motion_end_field = {place_of<&Motion<Dim>::end>,
                                                        {.name = "end",
                                                         .unit = "s",
                                                         .range = time_range,
                                                         .further_rule = "after `start`",
                                                         .default_text = "never",
                                                         .meaning = "from then on it stays as it is"}};

template <int Dim>
inline constexpr Field<Motion<Dim>> motion_frequency_field = {
    place_of<&Motion<Dim>::frequency>,
    {.name = "frequency", .required = true, .unit = "1/s", .range = above(0.0, 1e3), .meaning = "of that"}};
constexpr Key speed_of_turn(std::string_view meaning) {
  return {.name = "speed_deg",
          .required = true,
          .unit = "degrees/s",
          .stored = Stored::in_radians,
          .range = between(-1e5, 1e5),
          .meaning = meaning};
}
constexpr Key times_of_path(std::string_view meaning) {
  return {.name = "times",
          .required = true,
          .unit = "s",
          .range = time_range,
          .further_rule = "ascending, two or more",
          .meaning = meaning};
}
constexpr Key angles_of_path(std::string_view rule, std::string_view otherwise, std::string_view meaning) {
  return {.name = "angles_deg",
          .unit = "degrees",
          .stored = Stored::in_radians,
          .range = between(-36000.0, 36000.0),
          .further_rule = rule,
          .default_text = otherwise,
          .meaning = meaning};
}

template <int Dim>
inline constexpr auto sine_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::amplitude>,
     {.name = "amplitude",
      .required = true,
      .unit = "m",
      .range = coordinate_range,
      .meaning = "the obstacle goes from its place to `amplitude`, back, to minus `amplitude`, and so on"}},
    motion_frequency_field<Dim>,
    motion_start_field<Dim>,
    motion_end_field<Dim>,
});

template <int Dim>
inline constexpr auto turn_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::speed>, speed_of_turn("of a steady turn about `position`, counter-clockwise")},
    {{}, motion_axis_key},
    motion_start_field<Dim>,
    motion_end_field<Dim>,
});

template <int Dim>
inline constexpr auto path_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::times>,
     times_of_path(
         "when the obstacle is at each of the `shifts`. Between two of them it moves steadily, before the first "
         "and after the last it stands still")},
    {place_of<&Motion<Dim>::shifts>,
     {.name = "shifts",
      .required = true,
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "as many as `times`, the first 0",
      .meaning = "from `position`"}},
    {place_of<&Motion<Dim>::angles>,
     angles_of_path("as many as `times`, the first 0", "no turn", "turn about `position`, counter-clockwise")},
    {{}, motion_axis_key},
});

template <int Dim>
inline constexpr auto belt_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::belt>,
     {.name = "surface_velocity",
      .required = true,
      .unit = "m/s",
      .range = speed_range,
      .further_rule = fastest_rule,
      .meaning = "the obstacle stays in its place, and its surface moves: on each side the part of this vector along "
                 "the side. Not with the engines' own solvers"}},
    motion_start_field<Dim>,
    motion_end_field<Dim>,
});

template <int Dim>
inline constexpr auto gravity_sine_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::amplitude>,
     {.name = "amplitude",
      .required = true,
      .unit = "m/s^2",
      .range = gravity_component_range,
      .meaning = "this times a sine is added to `gravity`, which is what happens in a box that is shaken"}},
    motion_frequency_field<Dim>,
    motion_start_field<Dim>,
    motion_end_field<Dim>,
});

template <int Dim>
inline constexpr auto gravity_turn_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::speed>,
     speed_of_turn("of a steady turn of `gravity`, counter-clockwise: a box that tilts clockwise")},
    {{}, gravity_motion_axis_key},
    motion_start_field<Dim>,
    motion_end_field<Dim>,
});

template <int Dim>
inline constexpr auto gravity_path_fields = std::to_array<Field<Motion<Dim>>>({
    {place_of<&Motion<Dim>::times>,
     times_of_path("when gravity has each of the values. Between two of them it changes steadily, before the first and "
                   "after the last it stays")},
    {place_of<&Motion<Dim>::shifts>,
     {.name = "gravity",
      .type = "vectors",
      .unit = "m/s^2",
      .range = gravity_component_range,
      .further_rule = "as many as `times`",
      .default_text = "none",
      .meaning = "gravity itself, in the place of `world.gravity`. One of `gravity` and `angles_deg` is given"}},
    {place_of<&Motion<Dim>::angles>,
     angles_of_path("as many as `times`", "none", "turn of `world.gravity`, counter-clockwise")},
    {{}, gravity_motion_axis_key},
});

/// `[world.gravity_motion]`; `gravity` [m/s^2] is that of the world.
template <int Dim>
Motion<Dim> read_gravity_motion(TableReader& table, const Vec<Dim>& gravity);

/// `[obstacle.motion]` of an obstacle at `position` [m], no point of which is farther than `reach` [m] from there.
template <int Dim>
Motion<Dim> read_motion(TableReader& table, const Vec<Dim>& position, double reach, const WorldDescription<Dim>& world);

}  // namespace talus
