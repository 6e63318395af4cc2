#pragma once
// The loop.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/policy/observer.h"
#include "common/policy/sleep_control.h"
#include "common/scene/scene.h"
#include "common/simulation/emitter.h"
#include "common/simulation/interventions.h"
#include "common/simulation/rest_check.h"
#include "common/simulation/slope_control.h"
#include "common/simulation/watchdog.h"

namespace talus {

/// One run of a scene in a world of its own.
template <int Dim>
class Simulation {
 public:
  /// `world` must be new and made from scene.world.
  Simulation(const Scene<Dim>& scene, std::unique_ptr<World<Dim>> world, std::unique_ptr<SleepPolicy<Dim>> policy);

  /// Observers are called in the order added and must outlive the simulation. With none, nothing is prepared for them.
  void add_observer(Observer<Dim>& observer) { observers_.push_back(&observer); }

  /// One step: emit due bodies, step the world, recount the piles, let the policy decide, apply its three lists.
  void step();

  /// Whether the run is at its end: all frames are done or, where the scene says so, the world is at rest.
  bool finished() const { return step_ >= steps_ || at_rest_; }
  /// Whether the run ended since the world came to rest.
  bool at_rest() const { return at_rest_; }

  /// Calls on_end() of the observers: "finished", "interrupted", or what went wrong.
  void end(std::string_view reason);

  /// By hand between steps: events carry the cause `user`. Sleeping bodies near a removed one wake, since it may have
  /// supported them.
  BodyIndex add(const BodyDef<Dim>& body) { return world_->add(body); }
  void remove(BodyIndex body) { interventions_.remove(intervened(), {&body, 1}); }
  void thaw_all() { sleep_.wake_all(SleepCause::user); }
  /// Takes an obstacle away that is there, by its number in WorldDescription::obstacles. Sleeping bodies near it wake.
  void cut_obstacle(int number) { interventions_.cut_obstacle(intervened(), number); }
  /// Each step until release() pulls a body; it and what lies beside it stay awake meanwhile. The body must be in the
  /// world; once it is removed, this ends.
  void pull(const Pull<Dim>& pull) { interventions_.pull(pull); }
  void release() { interventions_.release(); }
  /// What an event of the scene does, at once. `event` must be as read_scene() allows, its bodies present. One that
  /// changes the policy must be of a kind that the scene has.
  void do_event(const Event<Dim>& event) { interventions_.act(intervened(), event); }

  /// The last finished step.
  Frame<Dim> frame() const {
    return {step_,
            time(),
            *world_,
            sleep_.piles(),
            sleep_.events(),
            phases_,
            watchdog_.warnings(),
            emitter_.total(),
            &sleep_.policy(),
            interventions_.done_events(),
            interventions_.clock().due().size(),
            probed_drift_,
            watchdog_.overlap(),
            [this](BodyIndex body) { return interventions_.must_stay_awake(*world_, body); }};
  }
  double time() const { return static_cast<double>(step_) * dt_; }
  const World<Dim>& world() const { return *world_; }
  const PileSet<Dim>& piles() const { return sleep_.piles(); }
  const Emitter<Dim>& emitter() const { return emitter_; }
  /// What observers were shown as Frame::warnings; after end() with the bodies that never appeared.
  std::span<const Warning> warnings() const { return watchdog_.warnings(); }
  /// Events of the scene so far, in the order in which they happened.
  std::span<const DoneEvent> done_events() const { return interventions_.done_events(); }
  /// What a probe of the last state found [D]. Frames have it in the place of the policy's estimate.
  void set_probed_drift(double drift) { probed_drift_ = drift; }

 private:
  bool needs_contacts() const;
  bool counts_piles() const;
  void add_initial_bodies();
  Intervened<Dim> intervened();
  bool watched() const { return !observers_.empty(); }
  void show();

  std::unique_ptr<World<Dim>> world_;
  SleepControl<Dim> sleep_;
  Emitter<Dim> emitter_;
  Watchdog<Dim> watchdog_;  // at work while there are observers
  std::vector<Observer<Dim>*> observers_;
  PhaseTimes phases_;
  double dt_;
  std::int64_t step_ = 0;
  DebugOptions debug_;
  std::vector<BodyIndex> asleep_at_start_;
  Interventions<Dim> interventions_;
  SlopeControl<Dim> slope_control_;
  std::function<std::unique_ptr<SleepPolicy<Dim>>(const std::string&)> make_policy_;  // that an event switches to
  std::optional<RestCheck<Dim>> rest_check_;  // where the scene ends at rest or an event waits for it
  bool ends_at_rest_;
  bool rested_ = false;   // after the last step
  bool at_rest_ = false;  // and the run has ended so
  std::optional<double> probed_drift_;
  std::int64_t steps_;
};

}  // namespace talus
