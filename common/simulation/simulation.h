#pragma once
// The loop.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/policy/sleep_policy.h"
#include "common/scene/happened.h"
#include "common/scene/scene.h"
#include "common/simulation/emitter.h"
#include "common/simulation/event_clock.h"
#include "common/simulation/moving_obstacles.h"
#include "common/simulation/observer.h"
#include "common/simulation/pull.h"
#include "common/simulation/rest_check.h"
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
  void remove(BodyIndex body);
  void thaw_all();
  /// Takes an obstacle away that is there, by its number in WorldDescription::obstacles. Sleeping bodies near it wake.
  void cut_obstacle(int number);
  /// Each step until release() pulls a body; it and what lies beside it stay awake meanwhile. The body must be in the
  /// world; once it is removed, this ends.
  void pull(const Pull<Dim>& pull) { pull_ = pull; }
  void release() { pull_.reset(); }
  /// What an event of the scene does, at once. `event` must be as read_scene() allows, its bodies present.
  void do_event(const Event<Dim>& event);

  /// The last finished step.
  Frame<Dim> frame() const {
    return {step_,
            time(),
            *world_,
            piles_,
            events_,
            phases_,
            watchdog_.warnings(),
            watchdog_.bodies_planned(),
            policy_.get(),
            event_clock_.due(),
            watchdog_.overlap()};
  }
  double time() const { return static_cast<double>(step_) * dt_; }
  const World<Dim>& world() const { return *world_; }
  const PileSet<Dim>& piles() const { return piles_; }
  const Emitter<Dim>& emitter() const { return emitter_; }
  /// What observers were shown as Frame::warnings; after end() with the bodies that never appeared.
  std::span<const Warning> warnings() const { return watchdog_.warnings(); }
  /// Events of the scene so far, in the order in which they happened.
  std::span<const DoneEvent> done_events() const { return done_events_; }
  /// What the policy expects its sleeping bodies to move once woken; none from a policy that does not measure it,
  /// has not yet, or cannot while many bodies move.
  std::optional<DriftEstimate> drift_estimate() const { return policy_->drift_estimate(*world_); }

 private:
  bool needs_contacts() const;
  bool counts_piles() const { return policy_->decides() || watched() || event_clock_.waits_for_layers(); }
  void count_piles();
  void place_pile();
  void decide();
  void apply();
  void freeze_initial_bodies();
  void move_obstacles();
  void change_gravity();
  void keep_moved_awake();
  void pull_body();
  void do_due_events();
  std::vector<BodyIndex> bodies_meant(const Event<Dim>& event) const;
  void kick(const Event<Dim>& event);
  void remove_obstacle(int number);
  void switch_policy(const std::string& kind);
  void thaw_near(const Box<Dim>& bounds, double reach);
  void thaw_now(std::span<const BodyIndex> bodies, SleepCause cause);
  void note_engine_sleep();
  bool watched() const { return !observers_.empty(); }
  void show();

  std::unique_ptr<World<Dim>> world_;
  std::unique_ptr<SleepPolicy<Dim>> policy_;
  Emitter<Dim> emitter_;
  PileSet<Dim> piles_;
  Watchdog<Dim> watchdog_;  // at work while there are observers
  std::vector<Observer<Dim>*> observers_;
  Decision<Dim> decision_;
  std::vector<BodyIndex> bodies_;            // scratch
  std::vector<SleepEvent> events_;           // of the last step
  std::vector<SleepEvent> user_events_;      // since the last step
  std::vector<std::uint8_t> asleep_before_;  // by body, with the engine's own sleeping only
  PhaseTimes phases_;
  double dt_;
  std::int64_t step_ = 0;
  bool engine_sleep_;
  DebugOptions debug_;
  std::vector<BodyIndex> asleep_at_start_;
  MovingObstacles<Dim> obstacles_;
  std::optional<Motion<Dim>> gravity_motion_;
  Vec<Dim> gravity_;              // before it changes by plan [m/s^2]
  Vec<Dim> gravity_of_sleepers_;  // when all bodies were last woken for it
  std::vector<Event<Dim>> scene_events_;
  std::vector<ObstacleName> obstacle_names_;
  EventClock<Dim> event_clock_;
  std::vector<DoneEvent> done_events_;
  std::optional<Pull<Dim>> pull_;
  std::vector<BodyIndex> pulled_;  // in this step: the body and what lies beside it, ascending
  std::map<std::string, std::unique_ptr<SleepPolicy<Dim>>> other_policies_;  // by name; that events switch to
  std::optional<RestCheck<Dim>> rest_check_;  // where the scene ends at rest or an event waits for it
  bool ends_at_rest_;
  bool rested_ = false;   // after the last step
  bool at_rest_ = false;  // and the run has ended so
  std::int64_t steps_;
};

}  // namespace talus
