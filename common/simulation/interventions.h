#pragma once
// What acts on a run besides its engine and its policy.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/policy/gravity_change.h"
#include "common/policy/sleep_control.h"
#include "common/scene/happened.h"
#include "common/scene/scene.h"
#include "common/simulation/emitter.h"
#include "common/simulation/event_clock.h"
#include "common/simulation/moving_obstacles.h"
#include "common/simulation/pull.h"

namespace talus {

/// What interventions act on; references are needed during one call only.
template <int Dim>
struct Intervened {
  World<Dim>& world;
  Emitter<Dim>& emitter;
  SleepControl<Dim>& sleep;
  double time = 0.0;  // [s]
  /// Another policy from now on.
  std::function<void(const std::string&)> switch_policy;
};

/// Events of the scene, obstacles and gravity that move by plan, and the pull of a hand: what they do between two
/// steps, and which bodies must stay awake for it.
template <int Dim>
class Interventions {
 public:
  explicit Interventions(const Scene<Dim>& scene);

  /// Before the first step: takes the obstacles out that events will add.
  static void take_out_absent(const Scene<Dim>& scene, World<Dim>& world);

  /// Before a step: what is due of the scene, where the world is at rest or not, with its piles.
  void do_due_events(const Intervened<Dim>& run, bool at_rest, std::span<const Pile<Dim>> piles);
  /// After that and after bodies were added: obstacles and gravity move on, and the pull acts.
  void move(const Intervened<Dim>& run);

  /// What an event of the scene does, at once. `event` must be as read_scene() allows, its bodies present. Returns on
  /// how many bodies it acted, where it chooses bodies.
  std::optional<int> act(const Intervened<Dim>& run, const Event<Dim>& event);
  /// Removes bodies and wakes those near them, since they may have supported them.
  void remove(const Intervened<Dim>& run, std::span<const BodyIndex> bodies) const;
  /// Takes an obstacle away that is there, and wakes what sleeps near it.
  void cut_obstacle(const Intervened<Dim>& run, int number) const;
  void pull(const Pull<Dim>& pull) { pull_ = pull; }
  void release() { pull_.reset(); }

  /// After a step: whether an awake body must stay so. One that touches an obstacle that moves, or is pulled, must
  /// follow it, unless it does so in its sleep, and one that gravity woke gets time to begin to move.
  bool must_stay_awake(const World<Dim>& world, BodyIndex body) const;
  /// Whether an obstacle moved in the last call of move().
  bool obstacles_moved() const { return obstacles_.any_moved(); }
  /// Whether after a time [s] an obstacle or gravity moves by plan, or the force of an event ends.
  bool changes_after(const World<Dim>& world, double time) const;
  const EventClock<Dim>& clock() const { return clock_; }
  /// Events of the scene so far, in the order in which they happened.
  std::span<const DoneEvent> done_events() const { return done_events_; }

 private:
  /// Of an event, until a time [s] if there is one.
  struct TimedPush {
    Push<Dim> push;
    std::optional<double> end;
  };
  void change_gravity(const Intervened<Dim>& run);
  void wake_for_gravity(const Intervened<Dim>& run);
  void pull_body(const Intervened<Dim>& run);
  void push_bodies(const Intervened<Dim>& run);
  void add(const Intervened<Dim>& run, const Event<Dim>& event) const;
  std::vector<int> obstacles_named(const Event<Dim>& event) const;
  void kick(const Intervened<Dim>& run, const Event<Dim>& event, std::span<const BodyIndex> bodies) const;
  int act_on_bodies(const Intervened<Dim>& run, const Event<Dim>& event);
  static std::vector<BodyIndex> sleepers_by(const World<Dim>& world, BodyIndex side, const Box<Dim>& bounds,
                                            double reach);

  double dt_;      // [s]
  double extent_;  // D [m]
  std::vector<Event<Dim>> events_;
  std::vector<ObstacleName> obstacle_names_;
  EventClock<Dim> clock_;
  std::vector<DoneEvent> done_events_;
  MovingObstacles<Dim> obstacles_;
  std::optional<Motion<Dim>> gravity_motion_;
  Vec<Dim> gravity_;  // before it changes by plan [m/s^2]
  GravityChange<Dim> gravity_change_;
  double time_ = 0.0;  // at which the last step began [s]
  std::optional<Pull<Dim>> pull_;
  std::vector<TimedPush> pushes_;
  std::vector<BodyIndex> held_awake_;  // in this step, ascending: pushed bodies, the pulled one and what lies beside it
};

}  // namespace talus
