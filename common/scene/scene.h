#pragma once
// A scene as plain structs: what a TOML scene file says, in SI units and radians.

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/pile/pile_params.h"
#include "common/policy/paper_params.h"
#include "common/policy/rest/adaptive_params.h"
#include "common/scene/instruments.h"
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
  bool waits_for_event = false;  // with do = "add"
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
  /// When the body of this number is due, from 0 on [s]; infinite where an event decides.
  double due_time(int number) const {
    if (waits_for_event) return std::numeric_limits<double>::infinity();
    const int before_its_grid = number - number % bodies_at_once();
    return start + before_its_grid / rate;
  }
  /// Bodies that are due by `time` [s], up to `count`.
  int due_by(double time) const;
  /// From the middle of the grid's first row to that of its last, along each axis [m].
  Vec<Dim> grid_extent() const { return ((grid.array() - 1).template cast<double>() * spacing.array()).matrix(); }
};

/// Policy by name with its parameters.
struct PolicyParams {
  std::string kind = "adaptive";
  PaperParams paper;
  AdaptiveParams adaptive;

  /// Mean drift that sleeping bodies may have [D]; nothing where the policy has no such limit.
  std::optional<double> tolerance() const {
    return kind == "adaptive" ? std::optional(adaptive.tolerance) : std::nullopt;
  }
  /// See AdaptiveParams.
  int rings() const { return kind == "adaptive" ? adaptive.rings : 0; }
};

inline constexpr std::array<std::string_view, 4> policy_kinds = {"full", "engine", "paper", "adaptive"};

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
  bool contacts = false;
  int threads = 1;
};

/// Steps of a run: at 60 a second half a year, at a quarter of a microsecond for a world at rest four minutes.
inline constexpr double most_steps = 1e9;

inline constexpr std::string_view when_at_rest = "rest";
inline constexpr std::string_view when_layer_density = "layer_density";
inline constexpr std::array<std::string_view, 2> event_conditions = {when_at_rest, when_layer_density};
/// What an event does.
enum class EventAction : std::uint8_t { remove, add, wake, kick, force, rate, policy, gravity, picture };
/// Their names, in the same order.
inline constexpr std::array<std::string_view, 9> event_actions = {"remove", "add",    "wake",    "kick",   "force",
                                                                  "rate",   "policy", "gravity", "picture"};
constexpr std::string_view to_string(EventAction action) { return event_actions[static_cast<std::size_t>(action)]; }
/// Policies that a run may switch between: the engine's own sleeping is part of its world.
inline constexpr std::array<std::string_view, 3> switchable_policies = {"full", "paper", "adaptive"};

/// One action, taken once between two steps. event_fields has the unit, range and effect of each field.
template <int Dim>
struct Event {
  std::optional<double> time = {};
  std::string when = {};
  double density = 0.0;  // of the densest layer of `pile`, with when_layer_density
  int pile = 0;
  std::int64_t bodies = 0;  // 0: no such condition
  EventAction action = EventAction::picture;
  std::vector<int> shapes = {};      // of the bodies that are meant; empty: of any
  std::vector<double> numbers = {};  // of these bodies; empty: of any
  std::vector<Vec<Dim>> box = {};    // lower and upper corner of where they are; empty: anywhere
  std::optional<int> obstacle = {};  // index of Scene::obstacle_names
  Vec<Dim> velocity = Vec<Dim>::Zero();
  Spin<Dim> spin = Spin<Dim>::Zero();
  Vec<Dim> force = Vec<Dim>::Zero();
  std::optional<double> seconds = {};
  int source = 0;
  double rate = 0.0;
  std::string policy = {};
  Vec<Dim> gravity = Vec<Dim>::Zero();
};

/// Obstacles of a world that have one name: from number `first` on, `count` of them.
struct ObstacleName {
  std::string name;
  int first = 0;
  int count = 0;
};

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
  Instruments<Dim> instruments;
  PolicyParams policy;
  RunParams run;
  std::string accuracy = "standard";  // accuracy.h: sets what the scene does not set itself
  std::uint64_t seed = 1;
  std::string toml;  // the file it was read from, `--set` values put in; empty for a scene made by a program
  std::filesystem::path folder;                 // of that file
  std::vector<std::filesystem::path> referred;  // files in or below it that `toml` names, relative to it
  std::vector<std::filesystem::path> included;  // files that it includes; `toml` has their values
  std::vector<std::string> reader_warnings;     // of parts that do not fill their mesh

  /// Steps of dt in one frame of output.
  std::int64_t steps_per_frame() const;
  std::int64_t steps() const { return run.frames * steps_per_frame(); }
  /// Bodies that are there from the start and that the sources drop.
  std::int64_t bodies_planned() const;
  /// Gravity at a time [s] by plan, without events [m/s^2].
  Vec<Dim> gravity_at(double time) const;
};

}  // namespace talus
