#pragma once
// A given world with what puts its bodies to sleep.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/policy/adaptive/adaptive_policy.h"
#include "common/policy/gravity_change.h"
#include "common/policy/sleep_control.h"
#include "common/sleeper/given_world.h"
#include "common/sleeper/sleeper_options.h"

namespace talus {

/// Runs policy `adaptive` on a given world. It makes the policy at the first contact with something that is no body,
/// since until then nothing can sleep, and again when the bodies have become much larger or smaller.
template <int Dim>
class SleepingWorld {
 public:
  SleepingWorld(const Vec<Dim>& gravity, const SleeperOptions& options);
  SleepingWorld(const SleepingWorld&) = delete;
  SleepingWorld& operator=(const SleepingWorld&) = delete;
  ~SleepingWorld() = default;

  const GivenWorld<Dim>& world() const { return world_; }
  GivenWorld<Dim>& world() { return world_; }

  BodyIndex add(const Shape<Dim>& shape, const Pose<Dim>& pose, bool stays_awake);
  void remove(BodyIndex body);
  /// Whether a body must not fall asleep.
  void keep_awake(BodyIndex body, bool stays_awake) {
    if ((stays_awake_[body] != 0) == stays_awake) return;
    ++(stays_awake ? left_ : came_);
    stays_awake_[body] = stays_awake ? 1 : 0;
  }

  using Events = std::vector<SleepEvent>;
  /// Wakes those that sleep, and returns them.
  Events wake(std::span<const BodyIndex> bodies, SleepCause cause);
  Events wake_all();
  /// Wakes a body that is about to move or was put elsewhere: its time at rest starts again at zero.
  Events set_moving(BodyIndex body, SleepCause cause);
  /// Puts bodies to sleep that slept in a saved world, and returns them. `settled`: no stability check is to come.
  Events freeze_saved(std::span<const BodyIndex> bodies, bool settled);
  /// Returns those that wake for it.
  Events set_gravity(const Vec<Dim>& gravity);

  /// Before the policy decides: makes it where it is missing or no longer fits. Returns the bodies that wake for that.
  Events prepare(std::span<const Contact<Dim>> contacts);
  /// Finishes a step of `dt` [s]. Before, world() must have been given its states and contacts.
  void end_motion(double dt);
  /// After it. `follows`: by body, whether it touches what moves it. Returns what was done.
  const Decision<Dim>& decide(const std::vector<std::uint8_t>& follows);

  /// The last step, as observers see it.
  Frame<Dim> frame(std::span<const SleepEvent> events, std::span<const Warning> warnings) const;
  double time() const { return time_; }
  std::int64_t step() const { return step_; }

  bool any_asleep() const { return count_ > std::ssize(world_.awake()); }
  /// Whether the next decision takes the contacts of all bodies that are awake.
  bool needs_all_contacts() const;
  /// Whether it takes those of this one, while nothing sleeps: to count it in the pile once it has touched something,
  /// and to find what supports it once it is near its sleep.
  bool needs_contacts(BodyIndex body) const;

  /// Whether a body sleeps and waits for no stability check.
  bool settled(BodyIndex body) const { return policy_ != nullptr && policy_->rules()->sleepers().settled(body); }
  /// Whether a sleeping body rests on an awake one.
  bool rests_on_awake(BodyIndex body) const {
    return policy_ != nullptr && policy_->rules()->rests_on_awake(world_, body);
  }
  /// D [m]; 0 before the first decision.
  double extent() const { return typical_.extent; }

 private:
  TypicalBody typical_now();
  void make_policy(const TypicalBody& typical);

  SleeperOptions options_;
  GivenWorld<Dim> world_;
  std::vector<std::uint8_t> stays_awake_;  // [body]
  std::vector<std::uint8_t> near_sleep_;   // [body] after the last decision
  TypicalBody typical_{.bounding_volume = 0.0, .extent = 0.0, .mass = 0.0};
  int typical_count_ = 0;        // bodies that might sleep when it was last looked for
  int came_ = 0;                 // bodies that may sleep, added since then
  int left_ = 0;                 // bodies that could sleep, removed since then
  int count_ = 0;                // bodies now
  std::optional<double> floor_;  // where a body first touched what is no body, or the lowest point of those saved [m]
  std::unique_ptr<SleepControl<Dim>> control_;
  const AdaptivePolicy<Dim>* policy_ = nullptr;  // that of control_
  std::optional<GravityChange<Dim>> gravity_;
  Decision<Dim> nothing_;
  PileSet<Dim> no_piles_{{}, {}};
  std::int64_t step_ = 0;
  double time_ = 0.0;  // [s]
};

}  // namespace talus
