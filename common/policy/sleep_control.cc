#include "common/policy/sleep_control.h"

#include <algorithm>
#include <cassert>

namespace talus {

template <int Dim>
SleepControl<Dim>::SleepControl(World<Dim>& world, std::unique_ptr<SleepPolicy<Dim>> policy,
                                std::vector<PileParams<Dim>> piles, const TypicalBody& typical, bool engine_sleep)
    : world_(world),
      policy_(std::move(policy)),
      piles_(std::move(piles), typical, policy_->counts_flying()),
      engine_sleep_(engine_sleep) {
  world_.set_ring(policy_->ring());
}

template <int Dim>
void SleepControl<Dim>::count_piles(double dt, bool recount) {
  if (engine_sleep_) note_engine_sleep();
  if (piles_.has_unplaced()) place_pile();
  if (piles_.needs_contacts() && !world_.awake().empty()) piles_.note_contacts(world_.contacts(), world_.states());
  if (recount) piles_.recount_all(world_.states());
  piles_.update(world_.states(), world_.awake(), dt, world_.units().times());
  assert(piles_.counts_match(world_.states()));
}

/// A pile whose place is not given begins where a body first touches ground or obstacle outside of the other piles.
template <int Dim>
void SleepControl<Dim>::place_pile() {
  const double apart = 2.0 * piles_.typical_body().extent;
  for (const Contact<Dim>& contact : world_.contacts()) {
    if (contact.b >= 0) continue;
    const auto piles = piles_.piles();
    const bool clear = std::all_of(piles.begin(), piles.end(), [&](const Pile<Dim>& pile) {
      return (horizontal<Dim>(contact.point) - horizontal<Dim>(pile.centre)).norm() > pile.radius + apart;
    });
    if (!clear) continue;
    piles_.place(contact.point, world_.states());
    return;
  }
}

template <int Dim>
void SleepControl<Dim>::decide(const Frame<Dim>& frame) {
  decision_.freeze.clear();
  decision_.thaw.clear();
  decision_.velocities.clear();
  if (policy_->decides()) policy_->decide(frame, decision_);
}

template <int Dim>
void SleepControl<Dim>::apply(std::int64_t step) {
  change_sleep(decision_.thaw, true);
  for (const VelocityChange<Dim>& change : decision_.velocities)
    world_.set_velocity(change.body, change.velocity, change.spin);
  change_sleep(decision_.freeze, false);
  close_events(step);
}

/// The one place where bodies are put to sleep or woken. `events` keeps those that were carried out: each body once,
/// and none that slept or was awake before.
template <int Dim>
void SleepControl<Dim>::change_sleep(std::vector<SleepEvent>& events, bool woke) {
  const BodyStates<Dim>& states = world_.states();
  std::erase_if(events, [&](const SleepEvent& event) { return (states.asleep.at(event.body) != 0) != woke; });
  if (events.empty()) return;
  std::ranges::stable_sort(events, {}, &SleepEvent::body);
  const auto same_body = [](const SleepEvent& a, const SleepEvent& b) { return a.body == b.body; };
  events.erase(std::unique(events.begin(), events.end(), same_body), events.end());
  bodies_.clear();
  for (SleepEvent& event : events) {
    event.woke = woke;
    bodies_.push_back(event.body);
  }
  if (woke)
    world_.thaw(bodies_);
  else
    world_.freeze(bodies_);
  note(events);
}

/// Updates piles and policy after bodies fell asleep or woke.
template <int Dim>
void SleepControl<Dim>::note(std::span<const SleepEvent> events) {
  for (const SleepEvent& event : events) {
    piles_.recount_body(world_.states(), event.body);
    if (known_asleep_.empty()) continue;
    known_asleep_.resize(world_.states().asleep.size(), 0);
    known_asleep_[event.body] = event.woke ? 0 : 1;
  }
  policy_->note(world_, events);
  new_events_.insert(new_events_.end(), events.begin(), events.end());
}

template <int Dim>
void SleepControl<Dim>::close_events(std::int64_t step) {
  for (SleepEvent& event : new_events_) event.step = step;
  std::ranges::stable_sort(new_events_, {}, &SleepEvent::body);
  events_.swap(new_events_);
  new_events_.clear();
}

/// The engine sends no events when it puts a body to sleep or wakes it, so the states are compared with the events.
template <int Dim>
void SleepControl<Dim>::note_engine_sleep() {
  const BodyStates<Dim>& states = world_.states();
  known_asleep_.resize(states.asleep.size(), 0);
  std::vector<SleepEvent> events;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.asleep[body] != known_asleep_[body] && states.removed[body] == 0)
      events.push_back({.body = body, .woke = states.asleep[body] == 0, .cause = SleepCause::engine});
  note(events);
}

template <int Dim>
std::vector<SleepEvent> SleepControl<Dim>::freeze(std::span<const BodyIndex> bodies, SleepCause cause) {
  std::vector<SleepEvent> events;
  for (const BodyIndex body : bodies) events.push_back({.body = body, .cause = cause});
  change_sleep(events, false);
  return events;
}

template <int Dim>
std::vector<SleepEvent> SleepControl<Dim>::wake(std::span<const BodyIndex> bodies, SleepCause cause) {
  std::vector<SleepEvent> events;
  for (const BodyIndex body : bodies)
    if (world_.states().removed[body] == 0) events.push_back({.body = body, .cause = cause});
  change_sleep(events, true);
  return events;
}

template <int Dim>
std::vector<SleepEvent> SleepControl<Dim>::wake_all(SleepCause cause) {
  std::vector<BodyIndex> all(world_.states().shape.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<BodyIndex>(i);
  return wake(all, cause);
}

/// Sleeping ones leave the account of the policy as if they had woken.
template <int Dim>
void SleepControl<Dim>::remove(std::span<const BodyIndex> bodies) {
  world_.remove(bodies);
  std::vector<SleepEvent> asleep;
  for (const BodyIndex body : bodies) {
    piles_.recount_body(world_.states(), body);
    if (world_.states().asleep[body] != 0) asleep.push_back({.body = body, .woke = true, .cause = SleepCause::user});
  }
  policy_->note(world_, asleep);
}

template <int Dim>
void SleepControl<Dim>::forget(BodyIndex body) {
  piles_.forget(body);
  policy_->forget(body);
}

template <int Dim>
void SleepControl<Dim>::switch_policy(std::unique_ptr<SleepPolicy<Dim>> policy) {
  wake_all(SleepCause::user);
  policy_ = std::move(policy);
  piles_.count_flying(policy_->counts_flying(), world_.states());
  world_.set_ring(policy_->ring());
}

template class SleepControl<2>;
template class SleepControl<3>;

}  // namespace talus
