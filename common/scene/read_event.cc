#include "common/scene/read_event.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/scene_fields.h"

namespace talus {
namespace {

/// The keys that belong to each action, besides its condition.
bool belongs(std::string_view key, EventAction action) {
  const bool of_bodies = action == EventAction::remove || action == EventAction::wake || action == EventAction::kick ||
                         action == EventAction::force;
  if (key == "shape" || key == "body" || key == "box") return of_bodies;
  if (key == "obstacle") return action == EventAction::remove || action == EventAction::add;
  if (key == "velocity" || key == "spin") return action == EventAction::kick;
  if (key == "seconds") return action == EventAction::force;
  if (key == "source") return action == EventAction::rate || action == EventAction::add;
  return key == to_string(action);  // force, rate, policy, gravity
}

EventAction read_action(TableReader& table) {
  std::string name;
  table.read(event_action_key, name);
  const auto found = std::ranges::find(event_actions, name);
  return found == event_actions.end() ? Event<2>().action : static_cast<EventAction>(found - event_actions.begin());
}

void check_keys(TableReader& table, EventAction action) {
  for (const std::string_view key : {"shape", "body", "box", "obstacle", "velocity", "spin", "force", "seconds",
                                     "source", "rate", "policy", "gravity"})
    if (!belongs(key, action)) table.forbid(key, fmt::format("means nothing for do = \"{}\"", to_string(action)));
  for (const std::string_view key : {"force", "rate", "policy", "gravity"})
    if (key == to_string(action)) table.require(key);
  if (action == EventAction::add && table.has("obstacle") == table.has("source"))
    table.error("", "must have one of obstacle and source for do = \"add\"");
  if (table.has("obstacle"))
    for (const std::string_view key : {"shape", "body", "box"}) table.forbid(key, "must not be given beside obstacle");
}

template <int Dim>
void read_event_shapes(TableReader& table, const ShapeNames& shapes, const Scene<Dim>& scene, Event<Dim>& event) {
  std::vector<std::string> names;
  if (shapes.names().empty())
    table.has("shape");
  else
    table.read("shape", names, shapes.names());
  constexpr int no_shape = -1;  // of a part of compounds: an event that names it means no body
  for (const std::string& name : names) {
    const std::vector<int> variants = shapes.variants(name);
    const std::vector<Shape<Dim>>& all = scene.world.shapes;
    for (const int variant : variants)
      for (int i = 0; i < std::ssize(all); ++i)
        if (i == variant || all[i].name.starts_with(all[variant].name + std::string(size_mark)))
          event.shapes.push_back(i);
    if (variants.empty()) event.shapes.push_back(no_shape);
  }
}

template <int Dim>
void read_event_obstacle(TableReader& table, const Scene<Dim>& scene, Event<Dim>& event) {
  std::vector<std::string> names;
  for (const ObstacleName& each : scene.obstacle_names) names.push_back(each.name);
  if (table.has("obstacle") && names.empty()) {
    table.error("obstacle", "must be the name of an obstacle; none here has a name");
    return;
  }
  std::string name;
  table.read("obstacle", name, names);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) event.obstacle = static_cast<int>(found - names.begin());
}

/// The keys of a condition.
template <int Dim>
void check_condition(TableReader& table, const Scene<Dim>& scene, const Event<Dim>& event) {
  const int conditions = (table.has("time") ? 1 : 0) + (table.has("when") ? 1 : 0) + (table.has("bodies") ? 1 : 0);
  if (conditions != 1) table.error("", "must have one of time, when and bodies");
  if (event.when != when_layer_density) {
    for (const std::string_view key : {"density", "pile"})
      table.forbid(key, fmt::format("means nothing without when = \"{}\"", when_layer_density));
    return;
  }
  table.require("density");
  if (event.pile >= std::ssize(scene.piles))
    table.error("pile", fmt::format("must be the number of a pile, of which there are {}", scene.piles.size()));
}

template <int Dim>
void check_event(TableReader& table, const Scene<Dim>& scene, const Event<Dim>& event) {
  check_condition(table, scene, event);
  if (!event.box.empty() && (event.box.size() != 2 || (event.box[0].array() > event.box[1].array()).any()))
    table.error("box", "must be two corners, the lower one first");
  if (std::ranges::any_of(event.numbers, [](double number) { return number != std::floor(number); }))
    table.error("body", "must be whole numbers");
  if ((table.has("source") || event.action == EventAction::rate) && event.source >= std::ssize(scene.sources))
    table.error("source", fmt::format("must be the number of a source, of which there are {}", scene.sources.size()));
  if (event.action == EventAction::policy && scene.policy.kind == "engine")
    table.error("do", "must not be policy where policy.kind is engine, whose sleeping is part of its world");
  if (event.action == EventAction::gravity && scene.gravity_motion)
    table.error("do", "must not be gravity where world.gravity_motion is given");
  if (event.action != EventAction::kick) return;
  table.check_later([speed = event.velocity.norm(), &world = scene.world](TableReader& complete) {
    const double fastest = fastest_speed<Dim>(world.dt, world.units);
    if (speed > fastest) complete.error("velocity", fmt::format("must be at most {:.6g} m/s", fastest));
  });
}

/// Bodies and obstacles are added once, and what an event adds is not there before.
template <int Dim>
void check_added(TableReader& table, const Scene<Dim>& scene, const Event<Dim>& event) {
  const auto same = [&](const Event<Dim>& other) {
    return other.action == EventAction::add && other.obstacle == event.obstacle && other.source == event.source;
  };
  if (std::ranges::any_of(scene.events, same))
    table.error(event.obstacle ? "obstacle" : "source", "must be added by no other event");
}

}  // namespace

template <int Dim>
Event<Dim> read_event(TableReader& table, const ShapeNames& shapes, const Scene<Dim>& scene) {
  Event<Dim> event;
  table.read_fields(event, event_fields<Dim>);
  event.action = read_action(table);
  read_event_shapes(table, shapes, scene, event);
  read_event_obstacle(table, scene, event);
  if (table.ok()) check_keys(table, event.action);
  if (table.ok()) check_event(table, scene, event);
  if (table.ok() && event.action == EventAction::add) check_added(table, scene, event);
  if (!table.ok()) return {};
  return event;
}

template Event<2> read_event(TableReader&, const ShapeNames&, const Scene<2>&);
template Event<3> read_event(TableReader&, const ShapeNames&, const Scene<3>&);

}  // namespace talus
