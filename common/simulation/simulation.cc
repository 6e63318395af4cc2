#include "common/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

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

/// Change of gravity, as a share of it, up to which bodies stay asleep: a tilt of 0.6 degrees.
constexpr double gravity_tolerance = 0.01;

/// In sqrt(D/g): how long a body stays awake after gravity woke it. At an acceleration of the tolerance it has then
/// moved by 0.02 D and is so fast that it counts as moving.
constexpr double awake_after_gravity = 2.0;

/// Gravity by plan, in a step that begins at `time` [s]; `still` before it changes.
template <int Dim>
Vec<Dim> planned_gravity(const Motion<Dim>& plan, const Vec<Dim>& still, double time) {
  return plan.turn_at(time) * (still + plan.shift_at(time));
}

/// Whether gravity became `woken`, at which all bodies were woken, within the steps that are to be kept awake. It is
/// the same number then, since it is computed in the same way.
template <int Dim>
bool woken_lately(const Motion<Dim>& plan, const Vec<Dim>& still, const Vec<Dim>& woken, std::int64_t step, double dt,
                  double extent) {
  constexpr double longest = 10.0;  // [s]; with little gravity
  const double time = std::min(longest, awake_after_gravity * std::sqrt(extent / std::max(woken.norm(), 1e-9)));
  const auto gravity = [&](std::int64_t at) { return planned_gravity(plan, still, static_cast<double>(at) * dt); };
  for (std::int64_t at = step; at > 0 && static_cast<double>(step - at) * dt < time; --at)
    if (gravity(at) == woken && gravity(at - 1) != woken) return true;
  return false;
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
      obstacles_(scene),
      gravity_motion_(scene.gravity_motion),
      gravity_(scene.world.gravity_vector()),
      gravity_of_sleepers_(gravity_),
      scene_events_(scene.events),
      obstacle_names_(scene.obstacle_names),
      event_clock_(scene.events),
      ends_at_rest_(scene.run.until == until_rest),
      steps_(scene.steps()) {
  if (ends_at_rest_ || event_clock_.waits_for_rest()) rest_check_.emplace(scene);
  for (const Event<Dim>& event : scene.events) {
    if (event.action != "policy") continue;
    Scene<Dim> with_other = scene;
    with_other.policy.kind = event.policy;
    other_policies_[event.policy] = make_policy(with_other);
  }
  for (std::size_t i = 0; policy_->decides() && i < scene.bodies.size(); ++i)
    if (scene.bodies[i].asleep) asleep_at_start_.push_back(static_cast<BodyIndex>(i));
}

/// In the first step, before the engine moves the bodies.
template <int Dim>
void Simulation<Dim>::freeze_initial_bodies() {
  world_->freeze(asleep_at_start_);
  for (const BodyIndex body : asleep_at_start_) {
    piles_.recount_body(world_->states(), body);
    user_events_.push_back({.step = step_ + 1, .body = body, .woke = false, .cause = SleepCause::user});
  }
  asleep_at_start_.clear();
}

template <int Dim>
void Simulation<Dim>::step() {
  Stopwatch watch;
  do_due_events();
  emitter_.emit(*world_, time());
  if (!asleep_at_start_.empty()) freeze_initial_bodies();
  if (watched()) watchdog_.note_added(*world_, step_);
  phases_.emit = watch.lap();
  move_obstacles();
  if (gravity_motion_) change_gravity();
  pulled_.clear();
  if (pull_) pull_body();
  world_->record_contacts(needs_contacts());
  if (watched()) watchdog_.start_step(*world_);
  world_->step();
  ++step_;
  phases_.step = watch.lap();
  if (watched()) watchdog_.end_step(*world_, step_);
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
    rested_ = rest_check_->update(*world_, step_) && emitter_.finished() && !obstacles_.moves_after(*world_, time()) &&
              !(gravity_motion_ && gravity_motion_->moves_after(time()));
  at_rest_ = ends_at_rest_ && rested_ && !event_clock_.waits();
  show();
  phases_.observe = watching + watch.lap();
}

template <int Dim>
void Simulation<Dim>::move_obstacles() {
  const std::vector<BodyIndex>& sleepers = obstacles_.move(*world_, time());
  if (engine_sleep_)
    world_->thaw(sleepers);  // note_engine_sleep() makes the events
  else if (!sleepers.empty())
    thaw_now(sleepers, SleepCause::lost_support);
}

/// Sleeping bodies do not feel that gravity changes: once it has by more than the tolerance, all wake.
template <int Dim>
void Simulation<Dim>::change_gravity() {
  const Vec<Dim> now = planned_gravity(*gravity_motion_, gravity_, time());
  world_->set_gravity(now);
  const double scale = std::max(now.norm(), gravity_of_sleepers_.norm());
  if ((now - gravity_of_sleepers_).norm() <= gravity_tolerance * scale) return;
  gravity_of_sleepers_ = now;
  thaw_all();
}

/// A body that touches an obstacle that moves must follow it, and one that gravity woke gets time to begin to move.
template <int Dim>
void Simulation<Dim>::keep_moved_awake() {
  if (gravity_motion_ && !decision_.freeze.empty() &&
      woken_lately(*gravity_motion_, gravity_, gravity_of_sleepers_, step_ - 1, dt_, piles_.typical_body().extent))
    decision_.freeze.clear();
  std::erase_if(decision_.freeze, [this](const SleepEvent& event) {
    return obstacles_.touch(*world_, event.body) || std::ranges::binary_search(pulled_, event.body);
  });
}

/// Sleeping neighbours are woken: neither the loss of a support nor a slow push wakes a body by itself.
template <int Dim>
void Simulation<Dim>::pull_body() {
  const BodyIndex body = pull_->body;
  if (world_->states().removed[body] != 0) {
    release();
    return;
  }
  const Box<Dim> bounds = world_->bounds_of(body);
  const Vec<Dim> margin = Vec<Dim>::Constant(0.05 * world_->shape_of(body).extent);
  world_->query_box({bounds.min() - margin, bounds.max() + margin}, pulled_);
  if (engine_sleep_)
    world_->thaw(pulled_);  // note_engine_sleep() makes the events
  else
    thaw_now(pulled_, SleepCause::user);
  const VelocityChange<Dim> change = pulled(*world_, *pull_, dt_);
  world_->set_velocity(body, change.velocity, change.spin);
}

template <int Dim>
bool Simulation<Dim>::needs_contacts() const {
  const bool for_piles = counts_piles() && (piles_.needs_contacts() || piles_.has_unplaced());
  const auto for_observer = [](const Observer<Dim>* observer) { return observer->needs_contacts(); };
  const bool for_watchdog = watched() && (obstacles_.any_moved() || watchdog_.needs_contacts(step_ + 1));
  return for_piles || for_watchdog || policy_->needs_contacts() || std::ranges::any_of(observers_, for_observer) ||
         debug_.gather_contacts;
}

/// Section 3.2. Without a policy and without observers piles are not counted.
template <int Dim>
void Simulation<Dim>::count_piles() {
  events_.swap(user_events_);
  user_events_.clear();
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
  keep_moved_awake();
}

template <int Dim>
void Simulation<Dim>::apply() {
  const auto take = [&](std::vector<SleepEvent>& list, bool woke) {
    bodies_.clear();
    for (SleepEvent& event : list) {
      event.step = step_;
      event.woke = woke;
      bodies_.push_back(event.body);
    }
    if (woke)
      world_->thaw(bodies_);
    else
      world_->freeze(bodies_);
    for (const BodyIndex body : bodies_) piles_.recount_body(world_->states(), body);
    events_.insert(events_.end(), list.begin(), list.end());
  };
  if (!decision_.thaw.empty()) take(decision_.thaw, true);
  for (const VelocityChange<Dim>& change : decision_.velocities)
    world_->set_velocity(change.body, change.velocity, change.spin);
  if (!decision_.freeze.empty()) take(decision_.freeze, false);
  std::stable_sort(events_.begin(), events_.end(), [](const auto& a, const auto& b) { return a.body < b.body; });
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

/// The engine sends no events when it puts a body to sleep or wakes it, so the states before and after are compared.
template <int Dim>
void Simulation<Dim>::note_engine_sleep() {
  const BodyStates<Dim>& states = world_->states();
  asleep_before_.resize(states.asleep.size(), 0);
  for (BodyIndex body = 0; body < states.size(); ++body) {
    if (states.asleep[body] == asleep_before_[body]) continue;
    asleep_before_[body] = states.asleep[body];
    events_.push_back({.step = step_, .body = body, .woke = states.asleep[body] == 0, .cause = SleepCause::engine});
    piles_.recount_body(states, body);
  }
}

template <int Dim>
void Simulation<Dim>::remove(BodyIndex body) {
  world_->remove(body);
  piles_.recount_body(world_->states(), body);
  thaw_near(world_->bounds_of(body), 0.05 * world_->shape_of(body).extent);
}

/// A body that rests on another one touches its box.
template <int Dim>
void Simulation<Dim>::thaw_near(const Box<Dim>& bounds, double reach) {
  const Vec<Dim> margin = Vec<Dim>::Constant(reach);
  std::vector<BodyIndex> neighbours;
  world_->query_box({bounds.min() - margin, bounds.max() + margin}, neighbours);
  thaw_now(neighbours, SleepCause::lost_support);
}

template <int Dim>
void Simulation<Dim>::do_due_events() {
  for (const int number : event_clock_.update(time(), emitter_.emitted(), rested_, piles_.piles())) {
    do_event(scene_events_[number]);
    done_events_.push_back({number, time()});
  }
}

template <int Dim>
void Simulation<Dim>::do_event(const Event<Dim>& event) {
  const std::string& action = event.action;
  if (action == "remove" && event.obstacle)
    remove_obstacle(*event.obstacle);
  else if (action == "remove")
    for (const BodyIndex body : bodies_meant(event)) remove(body);
  else if (action == "wake")
    thaw_now(bodies_meant(event), SleepCause::user);
  else if (action == "kick")
    kick(event);
  else if (action == "policy")
    switch_policy(event.policy);
  if (action == "rate") {
    emitter_.set_rate(event.source, event.rate, time());
    watchdog_.note_source(event.source, emitter_.source(event.source));
  }
  if (action == "gravity") {
    world_->set_gravity(event.gravity);
    thaw_all();
  }
}

template <int Dim>
std::vector<BodyIndex> Simulation<Dim>::bodies_meant(const Event<Dim>& event) const {
  const BodyStates<Dim>& states = world_->states();
  const auto meant = [&](BodyIndex body) {
    const Vec<Dim>& at = states.pose[body].position;
    return states.removed[body] == 0 &&
           (event.shapes.empty() || std::ranges::count(event.shapes, states.shape[body]) > 0) &&
           (event.numbers.empty() || std::ranges::count(event.numbers, static_cast<double>(body)) > 0) &&
           (event.box.empty() || Box<Dim>(event.box[0], event.box[1]).contains(at));
  };
  std::vector<BodyIndex> bodies;
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (meant(body)) bodies.push_back(body);
  return bodies;
}

/// The sum may be no faster than the engine allows.
template <int Dim>
void Simulation<Dim>::kick(const Event<Dim>& event) {
  const std::vector<BodyIndex> bodies = bodies_meant(event);
  thaw_now(bodies, SleepCause::user);
  const BodyStates<Dim>& states = world_->states();
  for (const BodyIndex body : bodies) {
    Vec<Dim> velocity = states.velocity[body] + event.velocity;
    Spin<Dim> spin = states.spin[body] + event.spin;
    velocity *= std::min(1.0, fastest_speed<Dim>(dt_) / std::max(velocity.norm(), 1e-9));
    spin *= std::min(1.0, fastest_spin(dt_) / std::max(spin.norm(), 1e-9));
    world_->set_velocity(body, velocity, spin);
  }
}

template <int Dim>
void Simulation<Dim>::remove_obstacle(int number) {
  const ObstacleName& name = obstacle_names_[number];
  for (int k = name.first; k < name.first + name.count; ++k)
    if (world_->has_obstacle(k)) cut_obstacle(k);
}

template <int Dim>
void Simulation<Dim>::cut_obstacle(int number) {
  const Box<Dim> bounds = bounds_at(world_->obstacle_shape(number), world_->obstacle_pose(number));
  world_->remove_obstacle(number);
  thaw_near(bounds, 0.05 * piles_.typical_body().extent);
}

/// A policy has no state of bodies that another one froze.
template <int Dim>
void Simulation<Dim>::switch_policy(const std::string& kind) {
  thaw_all();
  std::swap(policy_, other_policies_.at(kind));
}

template <int Dim>
void Simulation<Dim>::thaw_all() {
  std::vector<BodyIndex> all(world_->states().shape.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<BodyIndex>(i);
  thaw_now(all, SleepCause::user);
}

template <int Dim>
void Simulation<Dim>::thaw_now(std::span<const BodyIndex> bodies, SleepCause cause) {
  bodies_.clear();
  const BodyStates<Dim>& states = world_->states();
  std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(bodies_),
               [&](BodyIndex body) { return states.asleep[body] != 0 && states.removed[body] == 0; });
  world_->thaw(bodies_);
  for (const BodyIndex body : bodies_) {
    piles_.recount_body(states, body);
    user_events_.push_back({.step = step_ + 1, .body = body, .woke = true, .cause = cause});
  }
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace talus
