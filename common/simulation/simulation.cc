#include "common/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/pile/pile_fields.h"
#include "common/scene/scene_fields.h"
#include "common/scene/typical_body.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/stopwatch.h"

namespace talus {
namespace {

/// Where a pile's parameters leave open whether bodies in flight count, the policy decides it.
template <int Dim>
std::vector<PileParams<Dim>> piles_as_counted(std::vector<PileParams<Dim>> piles, const SleepPolicy<Dim>& policy) {
  for (PileParams<Dim>& pile : piles)
    if (!pile.count_flying) pile.count_flying = policy.counts_flying();
  return piles;
}

/// The scene. Throws InvalidValue where a source or a pile has a value outside of its range.
template <int Dim>
const Scene<Dim>& checked(const Scene<Dim>& scene) {
  for (std::size_t i = 0; i < scene.sources.size(); ++i)
    check_fields(scene.sources[i], source_fields<Dim>, fmt::format("source[{}]", i));
  for (std::size_t i = 0; i < scene.piles.size(); ++i)
    check_fields(scene.piles[i], pile_fields<Dim>, fmt::format("pile[{}]", i));
  return scene;
}

}  // namespace

template <int Dim>
Simulation<Dim>::Simulation(const Scene<Dim>& scene, std::unique_ptr<World<Dim>> world,
                            std::unique_ptr<SleepPolicy<Dim>> policy)
    : world_(std::move(world)),
      policy_(std::move(policy)),
      emitter_(checked(scene)),
      piles_(piles_as_counted(scene.piles, *policy_), typical_body(scene)),
      watchdog_(scene, world_->speed_limits()),
      dt_(scene.world.dt),
      engine_sleep_(scene.world.engine_sleep),
      debug_(scene.world.debug),
      interventions_(scene),
      ends_at_rest_(scene.run.until == until_rest),
      steps_(scene.steps()) {
  world_->set_ring(policy_->ring());
  if (ends_at_rest_ || interventions_.clock().waits_for_rest()) rest_check_.emplace(scene);
  if (std::ranges::count(scene.events, EventAction::policy, &Event<Dim>::action) > 0)
    make_policy_ = [with_other = Scene<Dim>(scene)](const std::string& kind) mutable {
      with_other.policy.kind = kind;
      return make_policy(with_other);
    };
  for (std::size_t i = 0; policy_->decides() && i < scene.bodies.size(); ++i)
    if (scene.bodies[i].asleep) asleep_at_start_.push_back(static_cast<BodyIndex>(i));
}

/// In the first step, before the engine moves the bodies.
template <int Dim>
void Simulation<Dim>::freeze_initial_bodies() {
  std::vector<SleepEvent> events;
  for (const BodyIndex body : asleep_at_start_) events.push_back({.body = body, .cause = SleepCause::user});
  change_sleep(events, false);
  asleep_at_start_.clear();
}

template <int Dim>
void Simulation<Dim>::step() {
  Stopwatch watch;
  probed_drift_.reset();
  events_.clear();
  interventions_.do_due_events(intervened(), rested_, piles_.piles());
  emitter_.emit(*world_, time());
  if (!asleep_at_start_.empty()) freeze_initial_bodies();
  if (watched()) watchdog_.note_added(*world_, step_);
  phases_.emit = watch.lap();
  interventions_.move(intervened());
  world_->record_contacts(needs_contacts());
  if (watched()) watchdog_.start_step(*world_);
  world_->step();
  ++step_;
  phases_.step = watch.lap();
  if (watched()) watchdog_.end_step(*world_, step_);
  for (Observer<Dim>* observer : observers_) observer->on_motion(*world_, time());
  const double watching = watch.lap();
  const EngineTimes engine = world_->times();
  phases_.collide = engine.collide;
  phases_.solve = engine.solve;
  phases_.read = engine.read;
  count_piles();
  phases_.count = watch.lap();
  decide();
  phases_.decide = watch.lap();
  apply();
  phases_.apply = watch.lap();
  if (rest_check_)
    rested_ = rest_check_->update(*world_, step_) && emitter_.finished() && !interventions_.move_after(*world_, time());
  at_rest_ = ends_at_rest_ && rested_ && !interventions_.clock().waits();
  show();
  phases_.observe = watching + watch.lap();
}

template <int Dim>
Intervened<Dim> Simulation<Dim>::intervened() {
  return {.world = *world_,
          .emitter = emitter_,
          .watchdog = watchdog_,
          .time = time(),
          .wake = [this](std::span<const BodyIndex> bodies, SleepCause cause) { thaw_now(bodies, cause); },
          .remove = [this](BodyIndex body) { forget(body); },
          .switch_policy = [this](const std::string& kind) { switch_policy(kind); }};
}

template <int Dim>
bool Simulation<Dim>::needs_contacts() const {
  const bool for_piles = counts_piles() && (piles_.needs_contacts() || piles_.has_unplaced());
  const auto for_observer = [](const Observer<Dim>* observer) { return observer->needs_contacts(); };
  const bool for_watchdog = watched() && (interventions_.obstacles_moved() || watchdog_.needs_contacts(step_ + 1));
  return for_piles || for_watchdog || policy_->needs_contacts() || std::ranges::any_of(observers_, for_observer) ||
         debug_.gather_contacts;
}

/// Section 3.2. Without a policy and without observers piles are not counted.
template <int Dim>
void Simulation<Dim>::count_piles() {
  if (!counts_piles()) return;
  if (engine_sleep_) note_engine_sleep();
  if (piles_.has_unplaced()) place_pile();
  if (piles_.needs_contacts() && !world_->awake().empty()) piles_.note_contacts(world_->contacts(), world_->states());
  if (debug_.recount_sleepers) piles_.recount_all(world_->states());
  piles_.update(world_->states(), world_->awake(), dt_);
  assert(piles_.counts_match(world_->states()));
}

/// A pile whose place is not given begins where a body first touches ground or obstacle outside of the other piles.
template <int Dim>
void Simulation<Dim>::place_pile() {
  const double clearance = 2.0 * piles_.typical_body().extent;
  for (const Contact<Dim>& contact : world_->contacts()) {
    if (contact.b >= 0) continue;
    const auto piles = piles_.piles();
    const bool clear = std::all_of(piles.begin(), piles.end(), [&](const Pile<Dim>& pile) {
      return (horizontal<Dim>(contact.point) - horizontal<Dim>(pile.centre)).norm() > pile.radius + clearance;
    });
    if (!clear) continue;
    piles_.place(contact.point, world_->states());
    return;
  }
}

template <int Dim>
void Simulation<Dim>::decide() {
  decision_.freeze.clear();
  decision_.thaw.clear();
  decision_.velocities.clear();
  if (policy_->decides()) policy_->decide(frame(), decision_);
}

template <int Dim>
void Simulation<Dim>::apply() {
  change_sleep(decision_.thaw, true);
  for (const VelocityChange<Dim>& change : decision_.velocities)
    world_->set_velocity(change.body, change.velocity, change.spin);
  change_sleep(decision_.freeze, false);
  close_events();
}

/// The one place where a run puts bodies to sleep or wakes them. `events` keeps those that were carried out: each body
/// once, and none that slept or was awake before.
template <int Dim>
void Simulation<Dim>::change_sleep(std::vector<SleepEvent>& events, bool woke) {
  const BodyStates<Dim>& states = world_->states();
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
    world_->thaw(bodies_);
  else
    world_->freeze(bodies_);
  note(events);
}

/// Tells all that keep account of sleeping bodies what happened.
template <int Dim>
void Simulation<Dim>::note(std::span<const SleepEvent> events) {
  for (const SleepEvent& event : events) {
    piles_.recount_body(world_->states(), event.body);
    if (known_asleep_.empty()) continue;
    known_asleep_.resize(world_->states().asleep.size(), 0);
    known_asleep_[event.body] = event.woke ? 0 : 1;
  }
  policy_->note(*world_, events);
  new_events_.insert(new_events_.end(), events.begin(), events.end());
}

/// From now on the events since the last step are those of this one.
template <int Dim>
void Simulation<Dim>::close_events() {
  for (SleepEvent& event : new_events_) event.step = step_;
  std::ranges::stable_sort(new_events_, {}, &SleepEvent::body);
  events_.swap(new_events_);
  new_events_.clear();
}

template <int Dim>
void Simulation<Dim>::show() {
  if (!watched()) return;
  watchdog_.check(*world_, events_, step_);
  const Frame<Dim> finished = frame();
  for (Observer<Dim>* observer : observers_) observer->on_frame(finished);
}

template <int Dim>
void Simulation<Dim>::end(std::string_view reason) {
  if (watched()) watchdog_.finish(*world_, step_);
  const Frame<Dim> last = frame();
  for (Observer<Dim>* observer : observers_) observer->on_end(last, reason);
}

/// The engine sends no events when it puts a body to sleep or wakes it, so the states are compared with the events.
template <int Dim>
void Simulation<Dim>::note_engine_sleep() {
  const BodyStates<Dim>& states = world_->states();
  known_asleep_.resize(states.asleep.size(), 0);
  std::vector<SleepEvent> events;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.asleep[body] != known_asleep_[body] && states.removed[body] == 0)
      events.push_back({.body = body, .woke = states.asleep[body] == 0, .cause = SleepCause::engine});
  note(events);
}

/// Takes a body out of the world. A sleeping one leaves the account of the policy as if it had woken.
template <int Dim>
void Simulation<Dim>::forget(BodyIndex body) {
  world_->remove(body);
  piles_.recount_body(world_->states(), body);
  if (world_->states().asleep[body] != 0)
    policy_->note(*world_, std::vector<SleepEvent>{{.body = body, .woke = true, .cause = SleepCause::user}});
}

/// A policy has no state of bodies that another one froze. So all wake, and the new one begins without state.
template <int Dim>
void Simulation<Dim>::switch_policy(const std::string& kind) {
  thaw_all();
  policy_ = make_policy_(kind);
  world_->set_ring(policy_->ring());
}

template <int Dim>
void Simulation<Dim>::thaw_all() {
  std::vector<BodyIndex> all(world_->states().shape.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<BodyIndex>(i);
  thaw_now(all, SleepCause::user);
}

template <int Dim>
void Simulation<Dim>::thaw_now(std::span<const BodyIndex> bodies, SleepCause cause) {
  std::vector<SleepEvent> events;
  for (const BodyIndex body : bodies)
    if (world_->states().removed[body] == 0) events.push_back({.body = body, .cause = cause});
  change_sleep(events, true);
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace talus
