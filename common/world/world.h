#pragma once
// The interface to a physics engine.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/world/body.h"
#include "common/world/gravity_units.h"
#include "common/world/sleep_ring.h"
#include "common/world/team.h"
#include "common/world/world_description.h"

namespace talus {

/// A body's state became NaN or infinite: the engine's mistake or a scene beyond its limits. The states that the world
/// holds are those before the step, for every body.
class NonFiniteState : public std::runtime_error {
 public:
  NonFiniteState(std::int64_t at_step, BodyIndex broken)
      : std::runtime_error("step " + std::to_string(at_step) + ": the state of body " + std::to_string(broken) +
                           " is not finite; everything up to the step before is kept"),
        step(at_step),
        body(broken) {}
  std::int64_t step;
  BodyIndex body;
};

/// Where the engine's time of the last step went [s]; zero where an engine does not measure it.
struct EngineTimes {
  double collide = 0.0;  // broad and narrow phase
  double solve = 0.0;    // islands, constraints, integration
  double read = 0.0;     // copying the states of the awake bodies
};

/// Limits at which an engine cuts the motion of a body. Box2D cuts speed and spin and Bullet the spin; the speed of
/// Bullet is the highest at which its continuous collision was tested.
struct SpeedLimits {
  double speed = std::numeric_limits<double>::infinity();  // [m/s]
  double spin = std::numeric_limits<double>::infinity();   // [rad/s]
};

/// A force on the centre of mass of a body [N].
template <int Dim>
struct Push {
  BodyIndex body = 0;
  Vec<Dim> force = Vec<Dim>::Zero();
};

/// A world of rigid bodies in one engine. A new world with the same calls gives the same bits.
///
/// A frozen body is solid and immovable: bodies rest on it, only thaw() wakes it, and a step does no work for it.
/// The checks and the bookkeeping of all engines are here; an engine derives from this class and supplies the
/// functions `engine_*`, see docs/extending.md. Bad input throws std::invalid_argument before the engine gets it.
template <int Dim>
class World {
 public:
  virtual ~World() = default;

  /// Throws InvalidValue unless the body is in the world.
  void require_present(BodyIndex body) const;

  /// Adds an awake body and returns its index, the number of bodies added before.
  BodyIndex add(const BodyDef<Dim>& body);

  /// Removes bodies; one that is listed twice is removed once. Sleeping bodies that rested on them stay asleep; the
  /// caller decides whether to wake them. Costs O(awake), however many they are.
  void remove(std::span<const BodyIndex> bodies);
  void remove(BodyIndex body) { remove({&body, 1}); }

  /// Advances by dt. Throws NonFiniteState if the state of a body is not finite afterwards; the states then stay as
  /// they were before the step, and each later call throws the same.
  void step();

  /// From now on these threads share the work of a step, where it is large enough. The bits are those of one thread.
  void share_among(const std::shared_ptr<Team>& team) {
    team_ = team;
    engine_share_among(team);
  }
  Team& team() const { return *team_; }

  /// Puts an awake body elsewhere, with the velocity that it has.
  void place(BodyIndex body, const Pose<Dim>& pose);

  /// Sets the velocity of an awake body.
  void set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin);

  /// A force on the centre of mass of an awake body throughout the next step [N], in addition to others. Only with the
  /// solver `small_steps`.
  void push(BodyIndex body, const Vec<Dim>& force);
  /// Adds `grip` [-] to the coefficient of friction of a body's contacts, from the next step on and until it is set
  /// again. A torque resists relative spin, and the bodies of a contact attract each other, both in proportion to the
  /// grip (ContactPoint::hold()). Of two bodies the larger grip counts. The contacts of a sleeping body keep the grip
  /// with which it fell asleep. Only with the solver `small_steps`.
  void set_grip(BodyIndex body, double grip);
  /// What push() has added for the next step.
  std::span<const Push<Dim>> pushes() const { return pushes_; }

  /// Stops awake bodies and makes them immovable: the engine no longer simulates them. Bodies already asleep are left
  /// alone. Acts at once; must not be called during step().
  void freeze(std::span<const BodyIndex> bodies);

  /// Makes sleeping bodies movable again, at rest; with a ring, at the place and with the velocity that the solve has
  /// given them. Bodies already awake are left alone. Acts at once; must not be called during step().
  void thaw(std::span<const BodyIndex> bodies);

  /// From now on sleeping bodies take part in the contact solve, see Ring; without value no longer. Only with the
  /// solver `small_steps`, and while no body sleeps.
  void set_ring(const std::optional<SleepRing>& ring);
  bool has_ring() const { return has_ring_; }
  /// Sleeping bodies that the solve of the last step moves: the caller wakes them. Ascending, each once.
  std::span<const BodyIndex> stirred() const { return engine_stirred(); }
  /// Whether a sleeping body takes part in solves and touches `side`, a body or an obstacle as contacts number them:
  /// then nothing need wake it when that one moves or goes.
  bool feels(BodyIndex body, BodyIndex side) const { return engine_feels(body, side); }
  /// Appends the contact points of sleeping bodies with another one, the ground or an obstacle as contacts number them,
  /// each with the impulses over a step that hold it. Nothing without a ring, and no point of a body that fell asleep
  /// before its first step.
  void sleeping_contacts(BodyIndex side, std::vector<Contact<Dim>>& found) const {
    engine_sleeping_contacts(side, found);
  }
  /// Number of sleeping bodies that were solved in the last step.
  int solved_sleepers() const { return engine_solved_sleepers(); }

  /// Where an obstacle that may move goes within the next step, with the velocity that this takes; it pushes awake
  /// bodies. Sleeping ones stay asleep: the caller wakes them. `number` in WorldDescription::obstacles.
  void move_obstacle(int number, const Pose<Dim>& to);
  /// The velocity of the surface of an obstacle that may move, from the next step on [m/s]: of a belt, which stays in
  /// its place. Its part along the surface drags awake bodies; sleeping ones stay asleep: the caller wakes them. Only
  /// with the solver `small_steps`.
  void set_surface_velocity(int number, const Vec<Dim>& velocity);
  Vec<Dim> surface_velocity(int number) const { return belts_.empty() ? Vec<Dim>::Zero() : belts_[number]; }
  /// All obstacles, where they are; those removed too.
  std::span<const Obstacle<Dim>> obstacles() const { return description_.obstacles; }
  const Pose<Dim>& obstacle_pose(int number) const { return description_.obstacles[number].pose; }

  /// Takes an obstacle out of the world. Sleeping bodies that rested on it stay asleep; the caller decides whether to
  /// wake them.
  void remove_obstacle(int number);
  /// Puts one that was taken out back, at this pose.
  void restore_obstacle(int number, const Pose<Dim>& at);
  const Shape<Dim>& obstacle_shape(int number) const { return description_.obstacles[number].shape; }
  bool has_obstacle(int number) const { return removed_obstacles_.empty() || removed_obstacles_[number] == 0; }

  /// Of a step [s].
  double dt() const { return description_.dt; }

  /// Gravity from the next step on [m/s^2]. Sleeping bodies stay asleep.
  void set_gravity(const Vec<Dim>& gravity);
  Vec<Dim> gravity() const { return description_.gravity_vector(); }
  /// Its size [m/s^2] and its direction, a unit vector; without gravity the direction that it had last.
  double gravity_size() const { return description_.gravity; }
  const Vec<Dim>& down() const { return description_.down; }

  /// Whether the steps from now on record their contacts. Off in a new world.
  void record_contacts(bool record) { record_contacts_ = record; }

  /// Contact points of awake bodies in the last step, if the step recorded them: in the same order whenever the input
  /// is the same, the points of one pair side by side. Each point is listed once: between two awake bodies under the
  /// one with the lower index. Depths follow from the shapes and may be negative. Nothing but a step changes this list.
  /// Its first use after a step takes 5 to 15 % of the step.
  std::span<const Contact<Dim>> contacts() const {
    gather_contacts();
    return contacts_;
  }

  /// States of all bodies; changes with add, remove, step, set_velocity, freeze, thaw.
  const BodyStates<Dim>& states() const { return states_; }

  /// The awake bodies, ascending. The cost of a step grows with their number.
  std::span<const BodyIndex> awake() const { return awake_; }

  /// Appends all bodies, awake or asleep, whose bounding box may touch `box` (a superset), ascending. An empty box
  /// (a lower corner above the upper one) touches nothing. Threads may call it side by side once one call after the
  /// last change has returned.
  void query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const;

  /// Goes up when a shape or an obstacle is new or another one than before. Stays 0 in the engines of talus.
  std::int64_t form() const { return form_; }
  /// Bodies removed so far.
  std::int64_t removals() const { return removals_; }

  /// The shapes that BodyStates::shape counts.
  std::span<const Shape<Dim>> shapes() const { return description_.shapes; }
  const Shape<Dim>& shape_of(BodyIndex body) const { return description_.shapes[states_.shape[body]]; }
  /// Smallest box, parallel to the axes, around a body.
  Box<Dim> bounds_of(BodyIndex body) const { return bounds_at(shape_of(body), states_.pose[body]); }

  /// Sides beyond which the world repeats itself. Bodies are between them, but for a thousandth of their distance.
  const Periodic<Dim>& periodic() const { return periodic_; }

  /// Of the images of a body the one that is nearest to a place: its pose, and the box around it.
  Pose<Dim> pose_near(BodyIndex body, const Vec<Dim>& place) const { return periodic_.near(states_.pose[body], place); }
  Box<Dim> bounds_near(BodyIndex body, const Vec<Dim>& place) const {
    return bounds_at(shape_of(body), pose_near(body, place));
  }

  EngineTimes times() const { return times_; }
  SpeedLimits speed_limits() const { return limits_; }
  const UnitScale& units() const { return description_.units; }

 protected:
  /// Throws std::invalid_argument on a bad description.
  explicit World(const WorldDescription<Dim>& description, const SpeedLimits& limits = {});
  World(const World&) = default;
  World(World&&) noexcept = default;
  World& operator=(const World&) = default;
  World& operator=(World&&) noexcept = default;

  const WorldDescription<Dim>& description() const { return description_; }
  /// By number of the obstacle, see set_surface_velocity(); empty: none ever had one.
  std::span<const Vec<Dim>> belts() const { return belts_; }
  bool records_contacts() const { return record_contacts_; }
  /// By body: what it was added as.
  std::span<const Image> images() const { return images_; }

  /// For an engine that moves bodies outside of step().
  BodyStates<Dim>& writable_states() { return states_; }

  // For a world that talus does not simulate: steps of any length, and bodies that come and go without end.
  void set_dt(double dt) { description_.dt = dt; }
  /// Adds a body without the checks for engines of talus. It gets the number of a removed body if `number` has one.
  BodyIndex add_unchecked(int shape, const Pose<Dim>& pose, std::optional<BodyIndex> number);
  /// The shape of this number, which is the next one or one that no body has.
  void put_shape(int number, const Shape<Dim>& shape);
  /// The same for an obstacle.
  void put_obstacle(int number, const Obstacle<Dim>& obstacle);
  void place_obstacle(int number, const Pose<Dim>& pose) { description_.obstacles[number].pose = pose; }

 private:
  // What an engine supplies. Indices are checked. freeze, thaw and remove have already changed states() and awake().

  /// Makes body number `body`, before it is in states(). Returns its pose as the engine stores it.
  virtual Pose<Dim> engine_add(BodyIndex body, const BodyDef<Dim>& def) = 0;
  /// Ascending, each once, at least one.
  virtual void engine_remove(std::span<const BodyIndex> bodies) = 0;

  /// Advances by dt; without the debug option `step_when_idle` and nothing awake, only does the upkeep that later steps
  /// need. Returns the times, without `read`.
  virtual EngineTimes engine_step() = 0;

  /// After a step with awake bodies: copies pose and velocity of the bodies in awake() to `states`. If one of them is
  /// not finite, copies nothing and returns that body.
  virtual std::optional<BodyIndex> engine_read(BodyStates<Dim>& states) = 0;

  /// Returns the pose as the engine stores it. An engine that has no such function throws.
  virtual Pose<Dim> engine_place(BodyIndex body, const Pose<Dim>& pose);
  virtual void engine_set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) = 0;

  /// By default throws: not every engine has the forces of a grip. An engine that has them reads states().grip in each
  /// step.
  virtual void engine_set_grip(BodyIndex body, double grip);

  /// Before a step: gives an obstacle that may move the velocity of its centre and the spin that take it to its next
  /// pose. An engine without moving obstacles throws.
  virtual void engine_move_obstacle(int number, const Pose<Dim>& to, const Vec<Dim>& velocity, const Spin<Dim>& spin);
  /// After the step: puts it there, at rest.
  virtual void engine_place_obstacle(int /*number*/, const Pose<Dim>& /*at*/) {}

  /// An engine that has no such functions throws.
  virtual void engine_remove_obstacle(int number);
  virtual void engine_restore_obstacle(int /*number*/) {}
  virtual void engine_set_gravity(const Vec<Dim>& gravity);

  /// Bodies that were awake; ascending, each once, at least one.
  virtual void engine_freeze(std::span<const BodyIndex> bodies) = 0;
  /// Bodies that were asleep; ascending, each once, at least one.
  virtual void engine_thaw(std::span<const BodyIndex> bodies) = 0;

  /// An engine in which sleeping bodies feel nothing throws on a ring.
  virtual void engine_set_ring(const std::optional<SleepRing>& ring);
  virtual std::span<const BodyIndex> engine_stirred() const { return {}; }
  virtual bool engine_feels(BodyIndex /*body*/, BodyIndex /*side*/) const { return false; }
  virtual void engine_sleeping_contacts(BodyIndex /*side*/, std::vector<Contact<Dim>>& /*found*/) const {}
  virtual int engine_solved_sleepers() const { return 0; }

  /// An engine that does all of its work on one thread does nothing.
  virtual void engine_share_among(const std::shared_ptr<Team>& /*team*/) {}

  /// Appends the bodies near `box` in any order; a body may come several times.
  virtual void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const = 0;

  /// Appends the contacts of the last step, as contacts() describes them. Since then no body was removed, fell asleep
  /// or woke; velocities may be new, and obstacles are where they went.
  virtual void engine_contacts(std::vector<Contact<Dim>>& contacts) const = 0;

  /// Whether the engine's own sleeping rule leaves a body awake; false for a frozen one. Called only with
  /// WorldDescription::engine_sleep.
  virtual bool engine_awake(BodyIndex body) const = 0;

  void place_obstacles();
  void require_obstacle(int number) const;
  /// Fills chosen_: ascending, each once.
  void choose(std::span<const BodyIndex> bodies);
  /// Of these, those that are asleep, or those that are not.
  void choose(std::span<const BodyIndex> bodies, bool asleep);
  void read_step();
  void gather_contacts() const;
  void stop(BodyIndex body);
  void follow_engine_sleep();

  WorldDescription<Dim> description_;
  Periodic<Dim> periodic_ = description_.periodic();
  SpeedLimits limits_;
  BodyStates<Dim> states_;
  std::vector<Image> images_;
  std::vector<BodyIndex> awake_;
  mutable std::vector<Contact<Dim>> contacts_;
  mutable bool contacts_wait_ = false;            // those of the last step are still to be gathered
  std::vector<BodyIndex> chosen_;                 // scratch
  std::vector<std::pair<int, Pose<Dim>>> moves_;  // of obstacles in the next step
  std::vector<std::uint8_t> removed_obstacles_;   // by number; empty: none
  std::vector<Push<Dim>> pushes_;                 // in the next step
  std::vector<Vec<Dim>> belts_;                   // by number: velocity of the surface [m/s]; empty: no belt
  std::shared_ptr<Team> team_ = std::make_shared<Team>(1);
  EngineTimes times_;
  std::int64_t steps_ = 0;
  std::int64_t form_ = 0;
  std::int64_t removals_ = 0;
  std::optional<NonFiniteState> failure_;
  bool record_contacts_ = false;
  bool has_ring_ = false;
};

/// In the world's present gravity.
template <int Dim>
double time_unit(double extent, const World<Dim>& world) {
  return time_unit(extent, world.gravity_size());
}

/// Makes an empty world of some engine.
template <int Dim>
using WorldMaker = std::function<std::unique_ptr<World<Dim>>(const WorldDescription<Dim>&)>;

}  // namespace talus
