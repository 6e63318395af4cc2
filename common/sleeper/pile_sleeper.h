#pragma once
// Sleep body by body for a world that talus does not simulate.

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/policy/observer.h"
#include "common/sleeper/body_traits.h"
#include "common/sleeper/given_step.h"
#include "common/sleeper/handle_table.h"
#include "common/sleeper/kinematic_bodies.h"
#include "common/sleeper/sleeper_options.h"
#include "common/sleeper/sleeping_world.h"
#include "common/sleeper/up_axis.h"

namespace talus {

/// Decides, step by step, which bodies of a foreign engine need not be simulated. After each step of the engine,
/// after_step() takes states and contacts of the bodies that are awake, and returns what to change. It works by policy
/// `adaptive` on one pile, whose place and slope follow from the contacts.
///
/// Every function that returns SleepChanges has already counted them as done: the caller carries them out in its engine
/// before anything else, and they are valid until the next call. All arguments are in the program's axes. Bad input
/// throws InvalidValue and changes nothing, and so does any call by an observer that would change something. Costs
/// follow the awake bodies, memory the most bodies there were at once.
template <int Dim>
class PileSleeper {
 public:
  /// `gravity` [m/s^2]. Throws InvalidValue on an option outside of its range.
  explicit PileSleeper(const Vec<Dim>& gravity, const SleeperOptions& options = {});
  PileSleeper(const PileSleeper&) = delete;
  PileSleeper& operator=(const PileSleeper&) = delete;
  /// Ends the observers and drops what they throw. Call end_observers() before to get it.
  ~PileSleeper();

  /// Adds a body, awake, at the pose of its centre of mass.
  Handle add(const BodyTraits<Dim>& traits, const Pose<Dim>& pose, BodyRole role = BodyRole::sleeps);
  /// Takes a body out. Sleeping bodies near it wake, since it may have supported them.
  const SleepChanges<Dim>& remove(Handle handle);

  /// Whether a body may sleep from now on: `sleeps` or `stays_awake`, of one that is not kinematic. One that may not
  /// wakes.
  const SleepChanges<Dim>& set_role(Handle handle, BodyRole role);
  BodyRole role(Handle handle) const { return handles_.at(handle, "body").role; }

  /// The bodies whose states after_step() needs: those awake and the kinematic ones. Valid until the next call.
  std::span<const Handle> followed();
  /// Whether the next after_step() takes the contacts of all bodies that are awake, since something sleeps.
  bool needs_all_contacts() const;
  /// If not: whether it takes those of this body. Contacts between bodies of which none is needed change nothing and
  /// may be left out.
  bool needs_contacts(Handle handle) const;
  /// One decision. Call it after each step of the engine, substeps too. Throws what an observer threw in the step
  /// before, then without a decision.
  const SleepChanges<Dim>& after_step(const GivenStep<Dim>& step);

  /// Before something acts on a body: a force, a new velocity. Without effect on an awake one.
  const SleepChanges<Dim>& wake(Handle handle);
  const SleepChanges<Dim>& wake_all();
  /// Wakes what sleeps near a box: where something that is no body of the sleeper came, went or exploded.
  const SleepChanges<Dim>& wake_near(const Box<Dim>& box);
  /// After the program has put a body elsewhere: it wakes, with the bodies near its old and its new place.
  const SleepChanges<Dim>& moved(Handle handle, const Pose<Dim>& to);
  /// From the next step on [m/s^2], at most as strong as a scene's. If it differs from before by more than a hundredth,
  /// all bodies wake.
  const SleepChanges<Dim>& set_gravity(const Vec<Dim>& gravity);

  /// Whether the handle names a body that is there.
  bool has(Handle handle) const { return handles_.has(handle); }
  bool asleep(Handle handle) const;
  /// Bodies that are there; kinematic ones count.
  int size() const { return handles_.size(); }
  int awake() const { return static_cast<int>(world().awake().size()); }

  /// From now on `observer` sees each step: a record, the live view, a watch for faults. Numbers of bodies are those of
  /// handle_of(), axes those of talus, with the last one up. Throws InvalidValue without SleeperOptions::enabled and
  /// within a report of an observer, and what the observer throws.
  void observe(std::unique_ptr<Observer<Dim>> observer);
  /// The shape that observers see of a body, in the axes of its traits; empty: they see its box still. Decisions need
  /// the box alone. Throws InvalidValue as a piece's check does.
  void set_pieces(Handle handle, const std::vector<Piece<Dim>>& pieces);
  /// Something that never moves and that observers see, such as a floor. Throws InvalidValue as a piece's check does.
  void add_static(const std::vector<Piece<Dim>>& pieces, const Pose<Dim>& pose);
  /// Ends the observers; else the destructor does. Throws what the first of them throws, once all have ended, and
  /// InvalidValue within a report of an observer.
  void end_observers(std::string_view reason = "finished");
  /// The body that has this number in frames, records and warnings. Numbers of removed bodies are used again. Throws
  /// InvalidValue if no body that is there has it; kinematic ones have none.
  Handle handle_of(BodyIndex body) const;

  /// Of every body that is not kinematic, in the order of their slots.
  std::vector<SavedSleep> snapshot() const;
  /// Puts to sleep again what slept, and wakes all others. Before it, the bodies must be in their saved places; `poses`
  /// has them, entry i of saved[i]. A program that has added its bodies again replaces their handles in `saved`.
  const SleepChanges<Dim>& restore(std::span<const SavedSleep> saved, std::span<const Pose<Dim>> poses);

 private:
  using Entry = HandleTable::Entry;
  using Events = std::vector<SleepEvent>;

  GivenWorld<Dim>& world() { return sleeping_.world(); }
  const GivenWorld<Dim>& world() const { return sleeping_.world(); }

  void check_step(const GivenStep<Dim>& step);
  void check_state(const GivenStep<Dim>& step, std::size_t i) const;
  void check_contact(const GivenContact<Dim>& contact, std::size_t i) const;
  void take_states(const GivenStep<Dim>& step);
  void take_contacts(const GivenStep<Dim>& step);
  BodyIndex side(Handle handle) const;
  Box<Dim> bounds(const Entry& entry) const;
  std::vector<BodyIndex> near(const Box<Dim>& box, double extent) const;
  void note(const Events& events);
  std::span<const Warning> warnings() const;
  void show_step();
  void tell(const std::function<void(Observer<Dim>&)>& call);
  void require_no_report() const;
  void clear_changes();
  void wake_reached();

  bool enabled_;
  AxisTurn<Dim> turn_;
  SleepingWorld<Dim> sleeping_;
  KinematicBodies<Dim> kinematic_{world()};
  HandleTable handles_;
  std::vector<Handle> kinematic_handles_;
  std::vector<Handle> handle_of_;       // [body] of the world
  std::vector<Handle> followed_;        // of the last call of followed()
  std::vector<Contact<Dim>> contacts_;  // of the step, as given
  std::vector<BodyIndex> reached_;      // scratch
  std::vector<std::uint8_t> follows_;   // [body] whether it touches a kinematic body that moves
  std::vector<std::int64_t> given_;     // [slot] number of the last step or restore() that had it
  std::int64_t steps_ = 0;
  SleepChanges<Dim> changes_;
  std::vector<std::unique_ptr<Observer<Dim>>> observers_;
  Events events_;               // since the last frame, where there are observers
  std::exception_ptr failure_;  // that an observer has thrown
  bool telling_ = false;        // observers are being called
};

}  // namespace talus
