#pragma once
// A scene as plain structs: what a TOML scene file says, in SI units and radians.

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/params/field.h"
#include "common/pile/pile_params.h"
#include "common/policy/adaptive/adaptive_params.h"
#include "common/policy/paper_params.h"
#include "common/scene/event.h"
#include "common/world/motion.h"
#include "common/world/world_description.h"

namespace talus {

/// Bodies of a scene in all: states and records of ten million bodies fill a present-day machine.
inline constexpr int most_bodies = 10'000'000;

/// A body that is in the world from the start.
template <int Dim>
struct InitialBody {
  BodyDef<Dim> def;
  bool asleep = false;  // with policies that decide on sleep
};

/// Drops bodies. A body is emitted only where its place is free: else it waits, and with it all after it.
/// source_fields has the unit, range and effect of each field.
template <int Dim>
struct Source {
  /// Indices of WorldDescription::shapes, dropped in turn; not empty. With sizes: those of each size side by side.
  std::vector<int> shapes = {0};
  std::vector<double> shares = {};  // of each size, added up to 1; empty: one size
  int count = 400;
  double start = 0.0;
  double rate = 6.6;
  Vec<Dim> position = Vec<Dim>::Unit(Dim - 1) * 10.0;
  Eigen::Vector<int, Dim> grid = Eigen::Vector<int, Dim>::Ones();
  Vec<Dim> spacing = Vec<Dim>::Zero();
  Vec<Dim> spread = Vec<Dim>::Zero();  // default of the scene reader: default_spread()
  Vec<Dim> velocity = Vec<Dim>::Zero();
  Vec<Dim> velocity_spread = Vec<Dim>::Zero();
  std::optional<Rotation<Dim>> orientation = {};  // not given: uniformly random
  double spin_spread = 0.0;
  Vec<Dim> sweep = Vec<Dim>::Zero();
  double sweep_period = 0.0;
  double ride_above = 0.0;

  int shapes_of_a_size() const { return static_cast<int>(shapes.size() / std::max<std::size_t>(1, shares.size())); }
  double share_of_size(int size) const {
    return shares.empty() ? 1.0 : shares[size] - (size > 0 ? shares[size - 1] : 0.0);
  }
  int bodies_at_once() const { return grid.prod(); }
  /// Overlap of bounding boxes [m] that still leaves a place free: bodies of a grid of one rotation may touch.
  double overlap_allowed() const { return orientation && bodies_at_once() > 1 ? 1e-4 : 0.0; }
  /// When the body of this number is due, from 0 on [s].
  double due_time(int number) const {
    const int before_its_grid = number - number % bodies_at_once();
    return start + before_its_grid / rate;
  }
  /// Bodies that are due by `time` [s], up to `count`.
  int due_by(double time) const;
  /// From the middle of the grid's first row to that of its last, along each axis [m].
  Vec<Dim> grid_extent() const { return ((grid.array() - 1).template cast<double>() * spacing.array()).matrix(); }
};

inline constexpr std::string_view random_orientation = "random";
inline constexpr std::array<std::string_view, 1> orientations = {random_orientation};
inline constexpr Key orientation_key = {.name = "orientation",
                                        .type = "text",
                                        .choices = orientations,
                                        .default_text = "`\"random\"`",
                                        .meaning = "each body has a random rotation, uniformly distributed"};
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
    {&Source<Dim>::count,
     {.name = "count",
      .range = between(1.0, most_bodies),
      .meaning = "bodies in all; a scene has no more than ten million"}},
    {&Source<Dim>::start,
     {.name = "start", .unit = "s", .range = between(0.0, 1e6), .meaning = "when the first body is due"}},
    {&Source<Dim>::rate,
     {.name = "rate",
      .unit = "1/s",
      .range = above(0.0, 1e6),
      .meaning = "bodies due per second. A rate above what the spout can clear only makes bodies wait"}},
    {&Source<Dim>::position,
     {.name = "position",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "10 above the origin",
      .meaning = "middle of the region where bodies appear. It must be so high that no body reaches into the ground"}},
    {&Source<Dim>::grid,
     {.name = "grid",
      .range = between(1.0, 1000.0),
      .meaning =
          "bodies that appear at once, in rows along each axis, around `position` and upwards from it. A grid of "
          "n comes as a whole, the next one n / `rate` later"}},
    {&Source<Dim>::spacing,
     {.name = "spacing",
      .type = "lengths",
      .unit = "m",
      .range = spread_range,
      .meaning = "from row to row of a grid. It must be so wide that the bodies' bounding boxes do not overlap, with a "
                 "random orientation at any rotation; with `angle_deg` they may touch"}},
    {&Source<Dim>::spread,
     {.name = "spread",
      .type = "lengths",
      .unit = "m",
      .range = spread_range,
      .default_text = "horizontal axes: radius of the largest body's bounding sphere, 0 where the grid has two rows or "
                      "more; vertical: 0",
      .meaning = "bodies appear uniformly within this distance of `position` on each axis. 0, or less than half the "
                 "default: bodies may stack up to the spout and stop it"}},
    {&Source<Dim>::velocity,
     {.name = "velocity",
      .unit = "m/s",
      .range = speed_range,
      .further_rule = "below 2 m a step in 2D, 500 m/s in 3D",
      .meaning = "of bodies when they appear. Too slow: the next one waits until this one has left"}},
    {&Source<Dim>::velocity_spread,
     {.name = "velocity_spread",
      .unit = "m/s",
      .range = between(0.0, 1e3),
      .meaning = "uniform to both sides of `velocity` on each axis"}},
    {{}, orientation_key},
    {{}, angle_key},
    {{}, axis_key},
    {&Source<Dim>::spin_spread,
     {.name = "spin_spread",
      .unit = "rad/s",
      .range = between(0.0, 1e4),
      .further_rule = "up to a quarter turn a step",
      .meaning = "spin, uniform to both sides of 0 on each axis"}},
    {&Source<Dim>::sweep,
     {.name = "sweep",
      .unit = "m",
      .range = coordinate_range,
      .meaning = "the spout moves back and forth between `position` - `sweep` and `position` + `sweep`"}},
    {&Source<Dim>::sweep_period,
     {.name = "sweep_period",
      .unit = "s",
      .range = between(0.0, 1e6),
      .further_rule = "0 or at least 0.01",
      .meaning = "duration of one motion back and forth. Must be above 0 with a `sweep`"}},
    {&Source<Dim>::ride_above,
     {.name = "ride_above",
      .unit = "m",
      .range = between(0.0, 1e4),
      .meaning = "the spout rises so as to stay this far above what lies beneath. 0: it does not, and a pile may grow "
                 "into it and stop it"}},
});

/// Policy by name with its parameters.
struct PolicyParams {
  std::string kind = "adaptive";
  PaperParams paper;
  AdaptiveParams adaptive;
};

inline constexpr std::array<std::string_view, 4> policy_kinds = {"full", "engine", "paper", "adaptive"};

inline constexpr auto policy_fields = std::to_array<Field<PolicyParams>>({
    {&PolicyParams::kind,
     {.name = "kind",
      .choices = policy_kinds,
      .meaning =
          "`full`: no body ever sleeps, the plain engine. `engine`: the engine's own rule, whole "
          "[islands](extending.md#glossary) at once. `paper`: the method as published. `adaptive`: each body by its "
          "contacts, see [method](method.md)"}},
    {{}, {.name = "adaptive", .type = "table", .default_text = "see below", .meaning = "`[policy.adaptive]`"}},
});

/// What ends a run.
inline constexpr std::string_view until_frames = "frames";
inline constexpr std::string_view until_rest = "rest";
inline constexpr std::array<std::string_view, 2> run_ends = {until_frames, until_rest};

/// Length of a run. Output comes in frames of one or more steps.
struct RunParams {
  std::int64_t frames = 300;
  double frame_rate = 30.0;
  std::string until = std::string(until_frames);
  double pace = 0.0;
};

/// Steps of a run: at 60 a second half a year, at a quarter of a microsecond for a world at rest four minutes.
inline constexpr double most_steps = 1e9;

inline constexpr auto run_fields = std::to_array<Field<RunParams>>({
    {&RunParams::frames,
     {.name = "frames",
      .range = between(1.0, most_steps),
      .further_rule = "at most 1e9 steps",
      .meaning = "frames of output, at most"}},
    {&RunParams::frame_rate,
     {.name = "frame_rate",
      .unit = "1/s",
      .range = between(1e-3, 1e5),
      .further_rule = "divides `world.steps_per_second`",
      .meaning = "frames per simulated second; a frame is one or more whole steps"}},
    {&RunParams::until,
     {.name = "until",
      .choices = run_ends,
      .meaning = "`rest`: the run ends before `frames` once all bodies have appeared, no obstacle is to move any more, "
                 "and for 4 sqrt(`D`/g) no awake body has moved farther than 0.01 `D` and none woke; events that wait "
                 "for a time or for rest happen first"}},
    {&RunParams::pace,
     {.name = "pace",
      .range = between(0.0, 1e6),
      .meaning = "simulated seconds per second at most: 1 is real time, to watch a run live. 0: as fast as it goes"}},
});

template <int Dim>
struct Scene {
  std::string title;  // one line, what `talus list` shows
  WorldDescription<Dim> world;
  std::vector<InitialBody<Dim>> bodies;  // in the world from the start; those of sources are numbered after them
  std::vector<Source<Dim>> sources;
  std::vector<Mover<Dim>> movers;             // obstacles that move by plan
  std::optional<Motion<Dim>> gravity_motion;  // shifts [m/s^2] and turns of gravity; none: it stays
  std::vector<ObstacleName> obstacle_names;
  std::vector<int> obstacles_of_tables;  // made by each [[obstacle]]; those of [pile.boundary] and fixed bodies follow
  std::vector<Event<Dim>> events;        // in the order of the file
  std::vector<PileParams<Dim>> piles;
  PolicyParams policy;
  RunParams run;
  std::uint64_t seed = 1;
  std::string toml;  // the file it was read from, `--set` values put in; empty for a scene made by a program
  std::filesystem::path folder;                 // of that file
  std::vector<std::filesystem::path> referred;  // files in or below it that `toml` names, relative to it
  std::vector<std::string> reader_warnings;     // of keys under an old name and of parts that do not fill their mesh

  /// Steps of dt in one frame of output.
  std::int64_t steps_per_frame() const;
  std::int64_t steps() const { return run.frames * steps_per_frame(); }
  /// Bodies that are there from the start and that the sources drop.
  std::int64_t bodies_planned() const;
  /// Gravity at a time [s] by plan, without events [m/s^2].
  Vec<Dim> gravity_at(double time) const;
};

inline constexpr Key dimension_key = {
    .name = "dimension",
    .required = true,
    .type = "whole number",
    .range = between(2.0, 3.0),
    .meaning = "whether bodies move in the x-z plane or in space; decides which engines fit"};

/// The first lines of a scene file.
template <int Dim>
inline constexpr auto scene_fields = std::to_array<Field<Scene<Dim>>>({
    {&Scene<Dim>::title,
     {.name = "title", .required = true, .further_rule = "one line", .meaning = "what `talus list` shows"}},
    {{}, dimension_key},
    {&Scene<Dim>::seed,
     {.name = "seed",
      .range = at_least(0.0),
      .further_rule = "below 2^63",
      .meaning = "all random numbers follow from it: the same seed, the same bodies, bit for bit"}},
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
    {{}, {.name = "policy", .type = "table", .default_text = "see below", .meaning = "`[policy]`"}},
    {{}, {.name = "run", .type = "table", .default_text = "see below", .meaning = "`[run]`"}},
    {{}, {.name = "debug", .type = "table", .default_text = "see below", .meaning = "`[debug]`"}},
});

}  // namespace talus
