#pragma once
// The keys of a scene file that belong to no other header.

#include <array>

#include "common/params/field.h"
#include "common/scene/accuracy.h"
#include "common/scene/scene.h"

namespace talus {

inline constexpr Key angle_key = {
    .name = "angle_deg",
    .unit = "degrees",
    .stored = Stored::in_radians,
    .range = between(-360.0, 360.0),
    .default_text = "none",
    .meaning =
        "rotation, counter-clockwise: of an obstacle or a body about the origin of its axes, "
        "of all bodies of a source in the place of a random one"};
inline constexpr Key axis_key = {.name = "axis",
                                 .dimension = 3,
                                 .type = "vector",
                                 .range = coordinate_range,
                                 .further_rule = "not zero",
                                 .default_text = "required with `angle_deg`",
                                 .meaning = "axis of the rotation, of any length"};

/// How fast a body may be at most, see fastest_speed() and fastest_spin().
inline constexpr std::string_view fastest_rule = "up to 2 m a step in 2D, 500 m/s in 3D";
inline constexpr std::string_view fastest_spin_rule = "up to a quarter turn a step";

template <int Dim>
inline constexpr auto source_fields = std::to_array<Field<Source<Dim>>>({
    {{},
     {.name = "shape",
      .type = "text or texts",
      .further_rule = "names of shapes",
      .default_text = "all shapes",
      .meaning = "shapes of the bodies, dropped in turn"}},
    {{},
     {.name = "scale",
      .type = "table",
      .default_text = "all of one size",
      .meaning = "sizes of the bodies: `[source.scale]`"}},
    {place_of<&Source<Dim>::count>,
     {.name = "count",
      .range = between(1.0, most_bodies),
      .meaning = "bodies in all; a scene has no more than ten million"}},
    {place_of<&Source<Dim>::start>,
     {.name = "start", .unit = "s", .range = between(0.0, 1e6), .meaning = "when the first body is due"}},
    {place_of<&Source<Dim>::rate>,
     {.name = "rate",
      .unit = "1/s",
      .range = above(0.0, 1e6),
      .meaning = "bodies due per second. A rate above what the spout can clear only makes bodies wait"}},
    {place_of<&Source<Dim>::position>,
     {.name = "position",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "10 above the origin",
      .meaning = "middle of the region where bodies appear. It must be so high that no body reaches into the ground"}},
    {place_of<&Source<Dim>::grid>,
     {.name = "grid",
      .range = between(1.0, 1000.0),
      .meaning =
          "bodies that appear at once, in rows along each axis, around `position` and upwards from it. A grid of "
          "n comes as a whole, the next one n / `rate` later"}},
    {place_of<&Source<Dim>::spacing>,
     {.name = "spacing",
      .type = "lengths",
      .unit = "m",
      .range = spread_range,
      .meaning = "from row to row of a grid. It must be so wide that the bodies' bounding boxes do not overlap, with a "
                 "random orientation at any rotation; with `angle_deg` they may touch"}},
    {place_of<&Source<Dim>::spread>,
     {.name = "spread",
      .type = "lengths",
      .unit = "m",
      .range = spread_range,
      .default_text = "horizontal axes: radius of the largest body's bounding sphere, 0 where the grid has two rows or "
                      "more; vertical: 0",
      .meaning = "bodies appear uniformly within this distance of `position` on each axis. 0, or less than half the "
                 "default: bodies may stack up to the spout and stop it"}},
    {place_of<&Source<Dim>::velocity>,
     {.name = "velocity",
      .unit = "m/s",
      .range = speed_range,
      .further_rule = fastest_rule,
      .meaning = "of bodies when they appear. Too slow: the next one waits until this one has left"}},
    {place_of<&Source<Dim>::velocity_spread>,
     {.name = "velocity_spread",
      .unit = "m/s",
      .range = between(0.0, 1e3),
      .meaning = "uniform to both sides of `velocity` on each axis"}},
    {{}, angle_key},
    {{}, axis_key},
    {place_of<&Source<Dim>::spin_spread>,
     {.name = "spin_spread",
      .unit = "rad/s",
      .range = between(0.0, 1e4),
      .further_rule = fastest_spin_rule,
      .meaning = "spin, uniform to both sides of 0 on each axis"}},
    {place_of<&Source<Dim>::sweep>,
     {.name = "sweep",
      .unit = "m",
      .range = coordinate_range,
      .meaning = "the spout moves back and forth between `position` - `sweep` and `position` + `sweep`"}},
    {place_of<&Source<Dim>::sweep_period>,
     {.name = "sweep_period",
      .unit = "s",
      .range = between(0.0, 1e6),
      .further_rule = "0 or at least 0.01",
      .meaning = "duration of one motion back and forth. Must be above 0 with a `sweep`"}},
    {place_of<&Source<Dim>::ride_above>,
     {.name = "ride_above",
      .unit = "m",
      .range = between(0.0, 1e4),
      .meaning = "the spout rises so as to stay this far above what lies beneath. 0: it does not, and a pile may grow "
                 "into it and stop it"}},
});

inline constexpr auto policy_fields = std::to_array<Field<PolicyParams>>({
    {place_of<&PolicyParams::kind>,
     {.name = "kind",
      .choices = policy_kinds,
      .meaning =
          "`full`: no body ever sleeps. `engine`: the engine's own rule, whole "
          "[islands](extending.md#glossary) at once. `paper`: the method as published. `adaptive`: each body by its "
          "contacts, see [method](method.md)"}},
    {{}, {.name = "adaptive", .type = "table", .default_text = "see below", .meaning = "`[policy.adaptive]`"}},
});

inline constexpr auto run_fields = std::to_array<Field<RunParams>>({
    {place_of<&RunParams::frames>,
     {.name = "frames",
      .range = between(1.0, most_steps),
      .further_rule = "at most 1e9 steps",
      .meaning = "frames of output, at most"}},
    {place_of<&RunParams::frame_rate>,
     {.name = "frame_rate",
      .unit = "1/s",
      .range = between(1e-3, 1e5),
      .further_rule = "divides `world.steps_per_second`",
      .meaning = "frames per simulated second; a frame is one or more whole steps"}},
    {place_of<&RunParams::until>,
     {.name = "until",
      .choices = run_ends,
      .meaning = "`rest`: the run ends before `frames` once all bodies have appeared, no obstacle is to move any more, "
                 "and for 4 sqrt(`D`/g) no awake body has moved farther than 0.01 `D` and none woke; events that wait "
                 "for a time or for rest happen first"}},
    {place_of<&RunParams::pace>,
     {.name = "pace",
      .range = between(0.0, 1e6),
      .meaning = "simulated seconds per second at most: 1 is real time, to watch a run live. 0: as fast as it goes"}},
    {place_of<&RunParams::contacts>,
     {.name = "contacts",
      .meaning = "whether frames have the contact points with their forces too: `talus view`, `film` and pictures draw "
                 "force chains then. 45 bytes a point and frame, which make the record of a heap three to "
                 "nine times as large"}},
    {place_of<&RunParams::threads>,
     {.name = "threads",
      .range = between(1.0, 64.0),
      .meaning = "number of threads that share a step while some hundreds of bodies are awake. The results have the "
                 "same bits for "
                 "any number"}},
});

inline constexpr Key dimension_key = {
    .name = "dimension",
    .required = true,
    .type = "whole number",
    .range = between(2.0, 3.0),
    .meaning = "whether bodies move in the x-z plane or in space; decides which engines fit"};

/// The first lines of a scene file.
template <int Dim>
inline constexpr auto scene_fields = std::to_array<Field<Scene<Dim>>>({
    {place_of<&Scene<Dim>::title>,
     {.name = "title", .required = true, .further_rule = "one line", .meaning = "what `talus list` shows"}},
    {{}, dimension_key},
    {place_of<&Scene<Dim>::seed>,
     {.name = "seed",
      .range = at_least(0.0),
      .further_rule = "below 2^63",
      .meaning = "all random numbers follow from it: the same seed, the same bodies, bit for bit"}},
    {place_of<&Scene<Dim>::accuracy>,
     {.name = "accuracy",
      .type = "text or number",
      .range = at_least(least_error),
      .choices = accuracy_names,
      .choice_of = level_within,
      .meaning =
          "a level, or the typical relative error of a heap's shape that is accepted, which takes the fastest level "
          "within it: "
          "0.2, 0.07 or 0.03. It sets what the scene does not set itself: `world.steps_per_second` so that a body that "
          "arrives goes at "
          "most 2, 1 or 0.5 times its thickness in a step; `sub_steps` 4, 8 or 8, in 3D 4, 8 or 16; the `tolerance` "
          "0.1, 0.05 or 0.02; the `rings` of a pour 0, 2 or 2. [Accuracy](accuracy.md#levels) has errors and times"}},
    {{},
     {.name = "include",
      .type = "text",
      .further_rule = "in or below the scene's folder",
      .default_text = "none",
      .meaning = "a scene file whose values hold where this one gives none; a list of tables such as `[[source]]` "
                 "replaces the whole list there"}},
    {{}, {.name = "world", .type = "table", .default_text = "see below", .meaning = "`[world]`"}},
    {{}, {.name = "ground", .type = "table", .default_text = "see below", .meaning = "`[ground]`"}},
    {{}, {.name = "shape", .required = true, .type = "tables by name", .meaning = "`[shape.NAME]`, one or more"}},
    {{},
     {.name = "source",
      .type = "tables",
      .default_text = "none",
      .meaning = "`[[source]]`; one, or a `[[body]]`, must be there"}},
    {{}, {.name = "body", .type = "tables", .default_text = "none", .meaning = "`[[body]]`"}},
    {{}, {.name = "obstacle", .type = "tables", .default_text = "none", .meaning = "`[[obstacle]]`"}},
    {{}, {.name = "event", .type = "tables", .default_text = "none", .meaning = "`[[event]]`"}},
    {{}, {.name = "pile", .type = "tables", .default_text = "none", .meaning = "`[[pile]]`"}},
    {{}, {.name = "gate", .type = "tables", .default_text = "none", .meaning = "`[[gate]]`"}},
    {{}, {.name = "region", .type = "tables", .default_text = "none", .meaning = "`[[region]]`"}},
    {{}, {.name = "load", .type = "tables", .default_text = "none", .meaning = "`[[load]]`"}},
    {{}, {.name = "policy", .type = "table", .default_text = "see below", .meaning = "`[policy]`"}},
    {{}, {.name = "run", .type = "table", .default_text = "see below", .meaning = "`[run]`"}},
});

inline constexpr Key event_action_key = {
    .name = "do",
    .required = true,
    .choices = event_actions,
    .meaning =
        "`remove`: bodies or an obstacle. `add`: an obstacle, or the bodies of a source; before, they are not there. "
        "`wake`: bodies. `kick`: bodies get `velocity` and `spin` in addition. `force`: bodies are pushed by `force`. "
        "`rate`: of a source. `policy`: another from now on, all bodies awake. `gravity`: another "
        "from now on, all bodies awake. `picture`: of the run folder, `event_0.png` for the first event"};

template <int Dim>
inline constexpr auto event_fields = std::to_array<Field<Event<Dim>>>({
    {place_of<&Event<Dim>::time>,
     {.name = "time",
      .unit = "s",
      .range = between(0.0, 1e6),
      .default_text = "none",
      .meaning = "when it happens. One of `time`, `when` and `bodies` is given"}},
    {place_of<&Event<Dim>::when>,
     {.name = "when",
      .choices = event_conditions,
      .default_text = "none",
      .meaning =
          "`rest`: it happens once the world is at rest, as in `run.until`. Of several such events each waits "
          "for the rest after the one before it. `layer_density`: once a layer of a pile is denser than `density`"}},
    {place_of<&Event<Dim>::density>,
     {.name = "density",
      .range = above(0.0, 1e3),
      .default_text = "required for `layer_density`",
      .meaning = "`layer_density`: number of bodies in the densest layer of the pile over the number that it has room "
                 "for, see [layers](#piles-pile)"}},
    {place_of<&Event<Dim>::pile>,
     {.name = "pile", .range = between(0.0, 4095.0), .meaning = "`layer_density`: number of the pile, from 0 on"}},
    {place_of<&Event<Dim>::bodies>,
     {.name = "bodies",
      .range = between(0.0, 1e7),
      .default_text = "none",
      .meaning = "it happens once so many bodies have appeared"}},
    {{}, event_action_key},
    {{},
     {.name = "shape",
      .type = "text or texts",
      .further_rule = "names of shapes",
      .default_text = "any",
      .meaning = "`remove`, `wake`, `kick`, `force`: bodies of these shapes only"}},
    {place_of<&Event<Dim>::numbers>,
     {.name = "body",
      .type = "whole number or numbers",
      .range = between(0.0, 1e7),
      .default_text = "any",
      .meaning =
          "`remove`, `wake`, `kick`, `force`: these bodies only, counted from 0 in the order in which they appear"}},
    {place_of<&Event<Dim>::box>,
     {.name = "box",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "two corners, the lower one first",
      .default_text = "anywhere",
      .meaning = "`remove`, `wake`, `kick`, `force`: bodies whose centre of mass is within only"}},
    {{},
     {.name = "obstacle",
      .type = "text",
      .further_rule = "`name` of an obstacle",
      .default_text = "none",
      .meaning = "`remove`, `add`: this obstacle and no body"}},
    {place_of<&Event<Dim>::velocity>,
     {.name = "velocity",
      .unit = "m/s",
      .range = speed_range,
      .further_rule = fastest_rule,
      .meaning = "`kick`: added to that of each body"}},
    {place_of<&Event<Dim>::spin>,
     {.name = "spin",
      .type = "vector, in 2D a number",
      .unit = "rad/s",
      .range = between(-1e4, 1e4),
      .meaning = "`kick`: added to that of each body"}},
    {place_of<&Event<Dim>::force>,
     {.name = "force",
      .unit = "N",
      .range = between(-1e12, 1e12),
      .default_text = "required for `force`",
      .meaning = "`force`: on the centre of mass of each body, which stays awake. Not with the engines' own solvers"}},
    {place_of<&Event<Dim>::seconds>,
     {.name = "seconds",
      .unit = "s",
      .range = above(0.0, 1e6),
      .default_text = "to the end",
      .meaning = "`force`: for so long"}},
    {place_of<&Event<Dim>::source>,
     {.name = "source", .range = between(0.0, 4095.0), .meaning = "`rate`, `add`: number of the source, from 0 on"}},
    {place_of<&Event<Dim>::rate>,
     {.name = "rate",
      .unit = "1/s",
      .range = above(0.0, 1e6),
      .default_text = "required for `rate`",
      .meaning = "`rate`: bodies due per second from now on, the next one at once"}},
    {place_of<&Event<Dim>::policy>,
     {.name = "policy",
      .choices = switchable_policies,
      .default_text = "required for `policy`",
      .meaning = "`policy`: from now on, with its parameters under `[policy]`. Not in a scene of policy `engine`"}},
    {place_of<&Event<Dim>::gravity>,
     {.name = "gravity",
      .unit = "m/s^2",
      .range = gravity_component_range,
      .default_text = "required for `gravity`",
      .meaning = "`gravity`: from now on"}},
});

}  // namespace talus
