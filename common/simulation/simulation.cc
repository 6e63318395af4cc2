#include "common/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/pile/pile_fields.h"
#include "common/scene/scene_fields.h"
#include "common/scene/typical_body.h"
#include "common/simulation/make_policy.h"
#include "common/world/stopwatch.h"

namespace talus {
namespace {

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
      sleep_(*world_, std::move(policy), checked(scene).piles, typical_body(scene), scene.world.engine_sleep),
      emitter_(scene),
      watchdog_(scene, world_->speed_limits()),
      dt_(scene.world.dt),
      debug_(scene.world.debug),
      interventions_(scene),
      slope_control_(scene),
      ends_at_rest_(scene.run.until == until_rest),
      steps_(scene.steps()) {
  if (ends_at_rest_ || interventions_.clock().waits_for_rest()) rest_check_.emplace(scene);
  if (std::ranges::count(scene.events, EventAction::policy, &Event<Dim>::action) > 0)
    make_policy_ = [with_other = Scene<Dim>(scene)](const std::string& kind) mutable {
      with_other.policy.kind = kind;
      return make_policy(with_other);
    };
  world_->share_among(std::make_shared<Team>(scene.run.threads));
  Interventions<Dim>::take_out_absent(scene, *world_);
  for (std::size_t i = 0; sleep_.policy().decides() && i < scene.bodies.size(); ++i)
    if (scene.bodies[i].asleep) asleep_at_start_.push_back(static_cast<BodyIndex>(i));
}

/// Before the events of time 0, which may wake them.
template <int Dim>
void Simulation<Dim>::add_initial_bodies() {
  emitter_.add_initial(*world_);
  sleep_.freeze(std::exchange(asleep_at_start_, {}), SleepCause::user);
}

template <int Dim>
void Simulation<Dim>::step() {
  Stopwatch watch;
  probed_drift_.reset();
  sleep_.start_step();
  if (step_ == 0) add_initial_bodies();
  interventions_.do_due_events(intervened(), rested_, piles().piles());
  if (slope_control_.active()) sleep_.wake(slope_control_.update(*world_, piles(), step_), SleepCause::avalanche);
  emitter_.emit(*world_, time());
  phases_.emit = watch.lap();
  interventions_.move(intervened());
  world_->record_contacts(needs_contacts());
  if (watched()) watchdog_.start_step(*world_);
  for (Observer<Dim>* observer : observers_) observer->on_start(*world_);
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
  if (counts_piles()) sleep_.count_piles(dt_, debug_.recount_sleepers);
  phases_.count = watch.lap();
  sleep_.decide(frame());
  phases_.decide = watch.lap();
  sleep_.apply(step_);
  phases_.apply = watch.lap();
  if (rest_check_)
    rested_ =
        rest_check_->update(*world_, step_) && emitter_.finished() && !interventions_.changes_after(*world_, time());
  at_rest_ = ends_at_rest_ && rested_ && !interventions_.clock().waits();
  show();
  phases_.observe = watching + watch.lap();
}

template <int Dim>
Intervened<Dim> Simulation<Dim>::intervened() {
  return {.world = *world_,
          .emitter = emitter_,
          .sleep = sleep_,
          .time = time(),
          .switch_policy = [this](const std::string& kind) { sleep_.switch_policy(make_policy_(kind)); }};
}

template <int Dim>
bool Simulation<Dim>::needs_contacts() const {
  const bool for_piles = counts_piles() && sleep_.piles_need_contacts();
  const auto for_observer = [](const Observer<Dim>* observer) { return observer->needs_contacts(); };
  const bool for_watchdog = watched() && (interventions_.obstacles_moved() || watchdog_.needs_contacts(step_ + 1));
  return for_piles || for_watchdog || sleep_.policy().needs_contacts() ||
         std::ranges::any_of(observers_, for_observer) || debug_.gather_contacts;
}

/// Without a policy and without observers piles are not counted.
template <int Dim>
bool Simulation<Dim>::counts_piles() const {
  return slope_control_.active() || sleep_.policy().decides() || watched() || interventions_.clock().waits_for_layers();
}

template <int Dim>
void Simulation<Dim>::show() {
  if (!watched()) return;
  watchdog_.check(*world_, sleep_.events(), step_);
  const Frame<Dim> finished = frame();
  for (Observer<Dim>* observer : observers_) observer->on_frame(finished);
}

template <int Dim>
void Simulation<Dim>::end(std::string_view reason) {
  if (watched()) watchdog_.finish(emitter_, step_);
  const Frame<Dim> last = frame();
  for (Observer<Dim>* observer : observers_) observer->on_end(last, reason);
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace talus
