#include "common/scene/happened.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace talus {

template <int Dim>
std::vector<std::uint8_t> absent_obstacles(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time) {
  std::vector<std::uint8_t> removed(scene.world.obstacles.size(), 0);
  const auto set = [&](const Event<Dim>& event, bool is_removed) {
    if (!event.obstacle) return;
    const ObstacleName& name = scene.obstacle_names[*event.obstacle];
    std::fill_n(removed.begin() + name.first, name.count, static_cast<std::uint8_t>(is_removed));
  };
  for (const Event<Dim>& event : scene.events)
    if (event.action == EventAction::add) set(event, true);
  for (const DoneEvent& each : done)
    if (each.time <= time) set(scene.events[each.number], scene.events[each.number].action == EventAction::remove);
  return removed;
}

template <int Dim>
std::string event_text(const Scene<Dim>& scene, int number) {
  const Event<Dim>& event = scene.events[number];
  const std::string_view action = to_string(event.action);
  if (event.obstacle) return fmt::format("{} obstacle {}", action, scene.obstacle_names[*event.obstacle].name);
  switch (event.action) {
    case EventAction::gravity:
      return fmt::format("gravity [{:#}]", fmt::join(event.gravity, ", "));
    case EventAction::policy:
      return fmt::format("policy {}", event.policy);
    case EventAction::rate:
      return fmt::format("rate {:g} of source {}", event.rate, event.source);
    case EventAction::add:
      return fmt::format("add the bodies of source {}", event.source);
    case EventAction::picture:
      return std::string(action);
    case EventAction::force:
    case EventAction::remove:
    case EventAction::wake:
    case EventAction::kick:
      break;
  }
  const bool some = !event.shapes.empty() || !event.numbers.empty() || !event.box.empty();
  return fmt::format("{} {} bodies", action, some ? "some" : "all");
}

template <int Dim>
std::string event_text(const Scene<Dim>& scene, const DoneEvent& event) {
  const std::string text = event_text(scene, event.number);
  return event.bodies ? fmt::format("{}: {}", text, *event.bodies) : text;
}

template <int Dim>
std::vector<std::string> idle_event_lines(const Scene<Dim>& scene, std::span<const DoneEvent> done) {
  std::vector<std::string> lines;
  for (const DoneEvent& event : done)
    if (event.bodies == 0)
      lines.push_back(
          fmt::format("event[{}], {}, found no body to act on", event.number, event_text(scene, event.number)));
  return lines;
}

template <int Dim>
WorldDescription<Dim> world_at(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time) {
  WorldDescription<Dim> world = scene.world;
  world.obstacles = obstacles_at(scene.world.obstacles, scene.movers, time);
  Vec<Dim> gravity = scene.gravity_at(time);
  for (const DoneEvent& each : done) {
    if (each.time > time) break;
    const Event<Dim>& event = scene.events[each.number];
    if (event.action == EventAction::gravity) gravity = event.gravity;
  }
  world.set_gravity(gravity);
  const std::vector<std::uint8_t> absent = absent_obstacles(scene, done, time);
  for (std::size_t k = absent.size(); k-- > 0;)
    if (absent[k] != 0) world.obstacles.erase(world.obstacles.begin() + static_cast<std::ptrdiff_t>(k));
  return world;
}

template <int Dim>
PolicyParams policy_at(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time) {
  PolicyParams policy = scene.policy;
  for (const DoneEvent& each : done) {
    if (each.time > time) break;
    const Event<Dim>& event = scene.events[each.number];
    if (event.action == EventAction::policy) policy.kind = event.policy;
  }
  return policy;
}

template <int Dim>
bool still_driven(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time) {
  const std::vector<std::uint8_t> absent = absent_obstacles(scene, done, time);
  const auto moves = [&](const Mover<Dim>& mover) {
    return absent[mover.first] == 0 && mover.motion.moves_after(time);
  };
  const auto pushes = [&](const DoneEvent& each) {
    const Event<Dim>& event = scene.events[each.number];
    return event.action == EventAction::force && (!event.seconds || each.time + *event.seconds > time);
  };
  return std::ranges::any_of(scene.movers, moves) || std::ranges::any_of(done, pushes) ||
         (scene.gravity_motion && scene.gravity_motion->moves_after(time));
}

template std::vector<std::uint8_t> absent_obstacles(const Scene<2>&, std::span<const DoneEvent>, double);
template std::vector<std::uint8_t> absent_obstacles(const Scene<3>&, std::span<const DoneEvent>, double);
template std::string event_text(const Scene<2>&, int);
template std::string event_text(const Scene<3>&, int);
template std::string event_text(const Scene<2>&, const DoneEvent&);
template std::string event_text(const Scene<3>&, const DoneEvent&);
template std::vector<std::string> idle_event_lines(const Scene<2>&, std::span<const DoneEvent>);
template std::vector<std::string> idle_event_lines(const Scene<3>&, std::span<const DoneEvent>);
template WorldDescription<2> world_at(const Scene<2>&, std::span<const DoneEvent>, double);
template WorldDescription<3> world_at(const Scene<3>&, std::span<const DoneEvent>, double);
template PolicyParams policy_at(const Scene<2>&, std::span<const DoneEvent>, double);
template PolicyParams policy_at(const Scene<3>&, std::span<const DoneEvent>, double);
template bool still_driven(const Scene<2>&, std::span<const DoneEvent>, double);
template bool still_driven(const Scene<3>&, std::span<const DoneEvent>, double);

}  // namespace talus
