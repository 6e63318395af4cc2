#pragma once
// What happens in a run at a time or under a condition.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/params/field.h"

namespace talus {

inline constexpr std::string_view when_at_rest = "rest";
inline constexpr std::string_view when_layer_density = "layer_density";
inline constexpr std::array<std::string_view, 2> event_conditions = {when_at_rest, when_layer_density};
/// What an event does.
enum class EventAction : std::uint8_t { remove, wake, kick, rate, policy, gravity, picture };
/// Their names, in the same order.
inline constexpr std::array<std::string_view, 7> event_actions = {"remove", "wake",    "kick",   "rate",
                                                                  "policy", "gravity", "picture"};
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

inline constexpr Key event_action_key = {
    .name = "do",
    .required = true,
    .choices = event_actions,
    .meaning =
        "`remove`: bodies or an obstacle. `wake`: bodies. `kick`: bodies get `velocity` and `spin` in "
        "addition. `rate`: of a source. `policy`: another from now on, all bodies awake. `gravity`: another "
        "from now on, all bodies awake. `picture`: of the run folder, `event_0.png` for the first event"};

template <int Dim>
inline constexpr auto event_fields = std::to_array<Field<Event<Dim>>>({
    {&Event<Dim>::time,
     {.name = "time",
      .unit = "s",
      .range = between(0.0, 1e6),
      .default_text = "none",
      .meaning = "when it happens. One of `time`, `when` and `bodies` is given"}},
    {&Event<Dim>::when,
     {.name = "when",
      .choices = event_conditions,
      .default_text = "none",
      .meaning =
          "`rest`: it happens once the world is at rest, as in `run.until`. Of several such events each waits "
          "for the rest after the one before it. `layer_density`: once a layer of a pile is denser than `density`"}},
    {&Event<Dim>::density,
     {.name = "density",
      .range = above(0.0, 1e3),
      .default_text = "required for `layer_density`",
      .meaning = "`layer_density`: number of bodies in the densest layer of the pile over the number that it has room "
                 "for, see [layers](#piles-pile)"}},
    {&Event<Dim>::pile,
     {.name = "pile", .range = between(0.0, 4095.0), .meaning = "`layer_density`: number of the pile, from 0 on"}},
    {&Event<Dim>::bodies,
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
      .meaning = "`remove`, `wake`, `kick`: bodies of these shapes only"}},
    {&Event<Dim>::numbers,
     {.name = "body",
      .type = "whole number or numbers",
      .range = between(0.0, 1e7),
      .default_text = "any",
      .meaning = "`remove`, `wake`, `kick`: these bodies only, counted from 0 in the order in which they appear"}},
    {&Event<Dim>::box,
     {.name = "box",
      .unit = "m",
      .range = coordinate_range,
      .further_rule = "two corners, the lower one first",
      .default_text = "anywhere",
      .meaning = "`remove`, `wake`, `kick`: bodies whose centre of mass is within only"}},
    {{},
     {.name = "obstacle",
      .type = "text",
      .further_rule = "`name` of an obstacle",
      .default_text = "none",
      .meaning = "`remove`: this obstacle and no body"}},
    {&Event<Dim>::velocity,
     {.name = "velocity", .unit = "m/s", .range = speed_range, .meaning = "`kick`: added to that of each body"}},
    {&Event<Dim>::spin,
     {.name = "spin",
      .type = "vector, in 2D a number",
      .unit = "rad/s",
      .range = between(-1e4, 1e4),
      .meaning = "`kick`: added to that of each body"}},
    {&Event<Dim>::source,
     {.name = "source", .range = between(0.0, 4095.0), .meaning = "`rate`: number of the source, from 0 on"}},
    {&Event<Dim>::rate,
     {.name = "rate",
      .unit = "1/s",
      .range = above(0.0, 1e6),
      .default_text = "required for `rate`",
      .meaning = "`rate`: bodies due per second from now on, the next one at once"}},
    {&Event<Dim>::policy,
     {.name = "policy",
      .choices = switchable_policies,
      .default_text = "required for `policy`",
      .meaning = "`policy`: from now on, with its parameters under `[policy]`. Not in a scene of policy `engine`"}},
    {&Event<Dim>::gravity,
     {.name = "gravity",
      .unit = "m/s^2",
      .range = gravity_component_range,
      .default_text = "required for `gravity`",
      .meaning = "`gravity`: from now on"}},
});

}  // namespace talus
