#include "tools/run/event_hits.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/scene/happened.h"

namespace talus {
namespace {

template <int Dim>
bool chooses_bodies(const Event<Dim>& event) {
  return event.action == EventAction::wake || event.action == EventAction::kick || event.action == EventAction::force ||
         (event.action == EventAction::remove && !event.obstacle);
}

/// As the simulation chooses them.
template <int Dim>
bool is_chosen(const Event<Dim>& event, const BodyStates<Dim>& states, BodyIndex body) {
  return (event.shapes.empty() || std::ranges::count(event.shapes, states.shape[body]) > 0) &&
         (event.numbers.empty() || std::ranges::count(event.numbers, static_cast<double>(body)) > 0) &&
         (event.box.empty() || Box<Dim>(event.box[0], event.box[1]).contains(states.pose[body].position));
}

}  // namespace

template <int Dim>
std::string event_text(const Scene<Dim>& scene, int number, const EventBodies& bodies) {
  const std::string text = event_text(scene, number);
  const bool counted = number < std::ssize(bodies) && bodies[number];
  return counted ? fmt::format("{}: {}", text, *bodies[number]) : text;
}

template <int Dim>
EventHits<Dim>::EventHits(const Scene<Dim>& scene, const Simulation<Dim>& simulation)
    : scene_(scene), simulation_(simulation), removed_(scene.bodies.size(), 0), bodies_(scene.events.size()) {}

/// Events act before the bodies of a step appear and move.
template <int Dim>
void EventHits<Dim>::on_start(const World<Dim>& world) {
  const BodyStates<Dim>& states = world.states();
  const auto count = [&](const Event<Dim>& event) {
    int hit = 0;
    for (BodyIndex body = 0; body < std::ssize(removed_); ++body) {
      const bool gone = states.removed[body] != 0;
      const bool acts = event.action == EventAction::remove ? gone && removed_[body] == 0 : !gone;
      hit += acts && is_chosen(event, states, body) ? 1 : 0;
    }
    return hit;
  };
  for (const DoneEvent& done : simulation_.done_events().subspan(seen_))
    if (chooses_bodies(scene_.events[done.number])) bodies_[done.number] = count(scene_.events[done.number]);
  seen_ = simulation_.done_events().size();
}

template <int Dim>
void EventHits<Dim>::on_frame(const Frame<Dim>& frame) {
  removed_.assign(frame.world.states().removed.begin(), frame.world.states().removed.end());
}

template <int Dim>
std::vector<std::string> EventHits<Dim>::idle_lines() const {
  std::vector<std::string> lines;
  for (int number = 0; number < std::ssize(bodies_); ++number)
    if (bodies_[number] == 0)
      lines.push_back(fmt::format("event[{}], {}, found no body to act on", number, event_text(scene_, number)));
  return lines;
}

template std::string event_text(const Scene<2>&, int, const EventBodies&);
template std::string event_text(const Scene<3>&, int, const EventBodies&);
template class EventHits<2>;
template class EventHits<3>;

}  // namespace talus
