#include "common/sleeper/pile_sleeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "common/math/require.h"
#include "common/math/require_finite.h"
#include "common/params/field.h"
#include "common/policy/near_bodies.h"
#include "common/policy/rest/rest_criterion.h"
#include "common/scene/policy_fields.h"
#include "common/shape/convex_distance.h"

namespace talus {
namespace {

/// In D: how far a sleeping body may be from where it fell asleep. Single precision rounds.
constexpr double stays_within = 1e-3;

template <int Dim>
const SleeperOptions& checked(const Vec<Dim>& gravity, const SleeperOptions& options) {
  require_finite(gravity, "gravity");
  check_fields(options.adaptive, adaptive_fields, "adaptive");
  require(options.adaptive.rings == 0, "adaptive.rings", options.adaptive.rings,
          "must be 0: the foreign engine solves the contacts");
  const double extent = options.extent.value_or(1.0);
  require(std::isfinite(extent) && extent > 0.0, "extent", extent, "must be finite and above 0");
  return options;
}

/// Quaternions and normals that were rounded to single precision pass.
constexpr double unit_within = 1e-3;
constexpr double normal_within = 1e-2;

template <int Dim>
void check_pose(const Pose<Dim>& pose, std::string_view field = "pose") {
  require_finite(pose.position, fmt::format("{}.position", field));
  if constexpr (Dim == 2)
    require(std::isfinite(pose.rotation.angle()), fmt::format("{}.rotation", field), pose.rotation.angle(),
            "must be finite");
  else
    require(std::abs(pose.rotation.norm() - 1.0) < unit_within, fmt::format("{}.rotation length", field),
            pose.rotation.norm(), "must be 1, as of each unit quaternion");
}

/// Whether check_pose() takes it, at less cost.
template <int Dim>
bool proper(const Pose<Dim>& pose) {
  if constexpr (Dim == 2)
    return pose.position.allFinite() && std::isfinite(pose.rotation.angle());
  else
    return pose.position.allFinite() && std::abs(pose.rotation.norm() - 1.0) < unit_within;
}

/// Whether check_contact() takes it, at less cost.
template <int Dim>
bool proper(const GivenContact<Dim>& contact) {
  // A sum is finite only if its terms are.
  const Vec<Dim> sum = contact.point + contact.friction_impulse;
  return std::isfinite(sum.sum() + contact.normal_impulse + contact.approach_speed + contact.depth) &&
         contact.normal_impulse >= 0.0 && contact.approach_speed >= 0.0 &&
         std::abs(contact.normal.norm() - 1.0) < normal_within;
}

}  // namespace

template <int Dim>
PileSleeper<Dim>::PileSleeper(const Vec<Dim>& gravity, const SleeperOptions& options)
    : enabled_(checked<Dim>(gravity, options).enabled),
      turn_(options.up.value_or(up_against<Dim>(gravity))),
      sleeping_(turn_.in(gravity), options) {}

template <int Dim>
Handle PileSleeper<Dim>::add(const BodyTraits<Dim>& traits, const Pose<Dim>& pose, BodyRole role) {
  require_no_report();
  check_pose<Dim>(pose);
  const bool kinematic = role == BodyRole::kinematic;
  const Shape<Dim> shape = shape_with(traits, kinematic);
  const Pose<Dim> at = turn_.in(pose);
  if (kinematic) return kinematic_handles_.emplace_back(handles_.add(role, kinematic_.add(shape, at)));
  const BodyIndex body = sleeping_.add(shape, at, role == BodyRole::stays_awake);
  const Handle handle = handles_.add(role, body);
  handle_of_.resize(world().states().asleep.size());
  handle_of_[body] = handle;
  return handle;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::remove(Handle handle) {
  clear_changes();
  const Entry entry = handles_.at(handle, "body");
  const Box<Dim> box = bounds(entry);
  const double extent = (box.max() - box.min()).norm();
  std::vector<BodyIndex> neighbours = near(box, extent);
  if (entry.role == BodyRole::kinematic) {
    kinematic_.remove(entry.number);
    std::erase(kinematic_handles_, handle);
  } else {
    std::erase(neighbours, entry.number);
    sleeping_.remove(entry.number);
  }
  handles_.remove(handle);
  note(sleeping_.wake(neighbours, SleepCause::lost_support));
  return changes_;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::set_role(Handle handle, BodyRole role) {
  clear_changes();
  const Entry& entry = handles_.at(handle, "body");
  require(entry.role != BodyRole::kinematic && role != BodyRole::kinematic, "role", static_cast<double>(role),
          "must not be kinematic, before or after: remove the body and add it again");
  handles_.set_role(handle, role);
  sleeping_.keep_awake(entry.number, role == BodyRole::stays_awake);
  if (role == BodyRole::stays_awake) note(sleeping_.wake(std::vector{entry.number}, SleepCause::user));
  return changes_;
}

template <int Dim>
Box<Dim> PileSleeper<Dim>::bounds(const Entry& entry) const {
  return entry.role == BodyRole::kinematic ? kinematic_.bounds(entry.number) : world().bounds_of(entry.number);
}

/// Bodies by a box of something that goes or comes.
template <int Dim>
std::vector<BodyIndex> PileSleeper<Dim>::near(const Box<Dim>& box, double extent) const {
  return bodies_near<Dim>(world(), box, waking_reach * extent);
}

template <int Dim>
std::span<const Handle> PileSleeper<Dim>::followed() {
  followed_.clear();
  if (!enabled_) return followed_;
  followed_ = kinematic_handles_;
  for (const BodyIndex body : world().awake()) followed_.push_back(handle_of_[body]);
  return followed_;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::after_step(const GivenStep<Dim>& step) {
  clear_changes();
  if (!enabled_) return changes_;
  check_step(step);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  tell([this](Observer<Dim>& observer) { observer.on_start(world()); });
  take_states(step);
  take_contacts(step);
  note(sleeping_.prepare(contacts_));
  if (sleeping_.any_asleep()) wake_reached();
  world().give_contacts(contacts_);
  sleeping_.end_motion(step.dt);
  tell([this](Observer<Dim>& observer) { observer.on_motion(world(), sleeping_.time()); });
  const Decision<Dim>& decision = sleeping_.decide(follows_);
  note(decision.thaw);
  note(decision.freeze);
  for (const VelocityChange<Dim>& change : decision.velocities)
    changes_.velocities.push_back(
        {handle_of_[change.body], turn_.out(change.velocity), turn_.spin_out(change.spin), SleepCause::momentum});
  if (!observers_.empty()) show_step();
  return changes_;
}

/// Of the observer that watches for faults.
template <int Dim>
std::span<const Warning> PileSleeper<Dim>::warnings() const {
  for (const auto& observer : observers_)
    if (!observer->warnings().empty()) return observer->warnings();
  return {};
}

template <int Dim>
void PileSleeper<Dim>::show_step() {
  std::ranges::stable_sort(events_, {}, &SleepEvent::body);
  for (SleepEvent& event : events_) event.step = sleeping_.step();
  tell([this](Observer<Dim>& observer) { observer.on_frame(sleeping_.frame(events_, warnings())); });
  events_.clear();
}

/// What an observer throws comes out of the next step, before that changes anything: the changes of this one must be
/// carried out.
template <int Dim>
void PileSleeper<Dim>::tell(const std::function<void(Observer<Dim>&)>& call) {
  telling_ = true;
  for (const auto& observer : observers_) {
    try {
      call(*observer);
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
    }
  }
  telling_ = false;
}

/// Wakes what kinematic bodies reach.
template <int Dim>
void PileSleeper<Dim>::wake_reached() {
  reached_.clear();
  for (const Handle handle : kinematic_handles_)
    kinematic_.find_sleepers(handles_.at(handle, "body").number, touching_distance * sleeping_.extent(), reached_);
  note(sleeping_.wake(reached_, SleepCause::lost_support));
  for (const BodyIndex body : reached_) follows_[body] = 1;
}

/// Everything is checked before anything is taken over.
template <int Dim>
void PileSleeper<Dim>::check_step(const GivenStep<Dim>& step) {
  require(std::isfinite(step.dt) && step.dt > 0.0, "dt", step.dt, "must be finite and above 0");
  const std::size_t count = step.bodies.size();
  require(step.poses.size() == count && step.velocities.size() == count && step.spins.size() == count, "bodies",
          static_cast<double>(count), "must be as many as poses, velocities and spins");
  given_.resize(handles_.entries().size(), 0);
  ++steps_;
  for (std::size_t i = 0; i < count; ++i) {
    check_state(step, i);
    std::int64_t& given = given_[step.bodies[i].slot];
    require(given != steps_, "bodies", step.bodies[i].slot, "must have each body once");
    given = steps_;
  }
  const auto require_given = [this](Handle handle) {
    require(given_[handle.slot] == steps_, "bodies", handle.slot, "must be among the bodies given: see followed()");
  };
  for (const BodyIndex body : world().awake()) require_given(handle_of_[body]);
  for (const Handle handle : kinematic_handles_) require_given(handle);
  for (std::size_t i = 0; i < step.contacts.size(); ++i) {
    const GivenContact<Dim>& contact = step.contacts[i];
    handles_.at(contact.a, "contact.a");
    if (contact.b != Handle{}) handles_.at(contact.b, "contact.b");
    if (!proper<Dim>(contact)) check_contact(contact, i);
  }
}

template <int Dim>
void PileSleeper<Dim>::check_contact(const GivenContact<Dim>& contact, std::size_t i) const {
  const std::string field = fmt::format("contacts[{}]", i);
  const auto require_positive = [&](double value, std::string_view of) {
    require(std::isfinite(value) && value >= 0.0, fmt::format("{}.{}", field, of), value,
            "must be finite and at least 0");
  };
  require_finite(contact.point, field + ".point");
  require_finite(contact.normal, field + ".normal");
  require(std::abs(contact.normal.norm() - 1.0) < normal_within, field + ".normal length", contact.normal.norm(),
          "must be 1; the normal points from b to a");
  require_positive(contact.normal_impulse, "normal_impulse");
  require_finite(contact.friction_impulse, field + ".friction_impulse");
  require_positive(contact.approach_speed, "approach_speed");
  require(std::isfinite(contact.depth), field + ".depth", contact.depth, "must be finite");
}

/// A sleeping body that was moved without moved() would hang where it is.
template <int Dim>
void PileSleeper<Dim>::check_state(const GivenStep<Dim>& step, std::size_t i) const {
  const Handle handle = step.bodies[i];
  const Entry& entry = handles_.at(handle, "bodies");
  if (!proper<Dim>(step.poses[i])) check_pose<Dim>(step.poses[i], fmt::format("poses[{}]", i));
  if (!step.velocities[i].allFinite()) require_finite(step.velocities[i], fmt::format("velocities[{}]", i));
  if (!step.spins[i].allFinite()) require_finite(step.spins[i], fmt::format("spins[{}]", i));
  if (entry.role == BodyRole::kinematic || world().states().asleep[entry.number] == 0) return;
  const double reach = 0.5 * world().shape_of(entry.number).extent;
  const Pose<Dim>& slept = world().states().pose[entry.number];
  const double way = max_displacement<Dim>(slept, turn_.in(step.poses[i]), reach);
  if (!(way <= stays_within * 2.0 * reach))
    require(false, fmt::format("way of sleeping body {}", handle.slot), way,
            "must be 0: a sleeping body was moved without a call of moved() or wake()");
}

template <int Dim>
void PileSleeper<Dim>::take_states(const GivenStep<Dim>& step) {
  for (std::size_t i = 0; i < step.bodies.size(); ++i) {
    const Entry& entry = handles_.at(step.bodies[i], "bodies");
    const Pose<Dim> pose = turn_.in(step.poses[i]);
    const Vec<Dim> velocity = turn_.in(step.velocities[i]);
    const Spin<Dim> spin = turn_.spin_in(step.spins[i]);
    if (entry.role == BodyRole::kinematic)
      kinematic_.move(entry.number, pose, velocity, spin, step.dt, sleeping_.extent());
    else if (world().states().asleep[entry.number] == 0)
      world().give(entry.number, pose, velocity, spin);
  }
}

/// The number of a contact's side as World::contacts() has it.
template <int Dim>
BodyIndex PileSleeper<Dim>::side(Handle handle) const {
  if (handle == Handle{}) return ground_index;
  const Entry& entry = handles_.at(handle, "contact");
  return entry.role == BodyRole::kinematic ? first_obstacle - entry.number : entry.number;
}

template <int Dim>
void PileSleeper<Dim>::take_contacts(const GivenStep<Dim>& step) {
  contacts_.clear();
  follows_.resize(world().states().asleep.size(), 0);
  for (const BodyIndex body : world().awake()) follows_[body] = 0;
  for (const GivenContact<Dim>& given : step.contacts) {
    const BodyIndex a = side(given.a);
    const BodyIndex b = side(given.b);
    if (b <= first_obstacle && a >= 0 && kinematic_.moved(first_obstacle - b)) follows_[a] = 1;
    if (a <= first_obstacle && b >= 0 && kinematic_.moved(first_obstacle - a)) follows_[b] = 1;
    contacts_.push_back({.a = a,
                         .b = b,
                         .point = turn_.in(given.point),
                         .normal = turn_.in(given.normal),
                         .normal_impulse = given.normal_impulse,
                         .friction_impulse = turn_.in(given.friction_impulse),
                         .approach_speed = given.approach_speed,
                         .depth = given.depth});
  }
}

template <int Dim>
void PileSleeper<Dim>::note(const Events& events) {
  for (const SleepEvent& event : events)
    (event.woke ? changes_.thaw : changes_.freeze).push_back({handle_of_[event.body], event.cause});
  if (!observers_.empty()) events_.insert(events_.end(), events.begin(), events.end());
}

/// A call by an observer would change what is being shown, the observers themselves or the changes of the step.
template <int Dim>
void PileSleeper<Dim>::require_no_report() const {
  require(!telling_, "call", "by an observer", "must come after the step");
}

template <int Dim>
void PileSleeper<Dim>::clear_changes() {
  require_no_report();
  changes_.thaw.clear();
  changes_.velocities.clear();
  changes_.freeze.clear();
}

template <int Dim>
bool PileSleeper<Dim>::needs_all_contacts() const {
  const auto needs = [](const auto& observer) { return observer->needs_contacts(); };
  return enabled_ && (sleeping_.needs_all_contacts() || std::ranges::any_of(observers_, needs));
}

template <int Dim>
void PileSleeper<Dim>::observe(std::unique_ptr<Observer<Dim>> observer) {
  require_no_report();
  require(enabled_, "enabled", "false", "must be true: without it a sleeper is given no states to show");
  telling_ = true;
  try {
    observer->on_frame(sleeping_.frame({}, {}));
  } catch (...) {
    telling_ = false;
    throw;
  }
  telling_ = false;
  observers_.push_back(std::move(observer));
}

template <int Dim>
void PileSleeper<Dim>::set_pieces(Handle handle, const std::vector<Piece<Dim>>& pieces) {
  require_no_report();
  const Entry& entry = handles_.at(handle, "body");
  for (const Piece<Dim>& piece : pieces) check_piece<Dim>(piece, "piece");
  if (pieces.empty()) return;
  const bool kinematic = entry.role == BodyRole::kinematic;
  Shape<Dim> shape = kinematic ? world().obstacle_shape(entry.number) : world().shape_of(entry.number);
  shape.pieces = pieces;
  if (kinematic)
    world().put_obstacle(entry.number, {shape, world().obstacle_pose(entry.number), true});
  else
    world().reshape(entry.number, shape);
}

template <int Dim>
void PileSleeper<Dim>::add_static(const std::vector<Piece<Dim>>& pieces, const Pose<Dim>& pose) {
  require_no_report();
  check_pose<Dim>(pose);
  BodyTraits<Dim> traits{.pieces = pieces};
  traits.bounds.setEmpty();
  for (const Piece<Dim>& piece : pieces)
    traits.bounds.extend(bounds_of<Dim>(piece, Eigen::Matrix<double, Dim, Dim>::Identity(), Vec<Dim>::Zero()));
  world().add_obstacle(shape_with(traits, true), turn_.in(pose), false);
}

template <int Dim>
void PileSleeper<Dim>::end_observers(std::string_view reason) {
  require_no_report();
  tell([&](Observer<Dim>& observer) { observer.on_end(sleeping_.frame({}, warnings()), reason); });
  observers_.clear();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

template <int Dim>
PileSleeper<Dim>::~PileSleeper() {
  try {
    end_observers();
  } catch (...) {  // such as a full disk; a destructor must not throw
    return;
  }
}

template <int Dim>
Handle PileSleeper<Dim>::handle_of(BodyIndex body) const {
  const bool known = body >= 0 && body < std::ssize(handle_of_) && handles_.has(handle_of_[body]);
  require(known, "body", body, "must be the number of a body that is there and not kinematic");
  return handle_of_[body];
}

template <int Dim>
bool PileSleeper<Dim>::needs_contacts(Handle handle) const {
  if (!enabled_) return false;
  const Entry& entry = handles_.at(handle, "body");
  return entry.role != BodyRole::kinematic && sleeping_.needs_contacts(entry.number);
}

template <int Dim>
bool PileSleeper<Dim>::asleep(Handle handle) const {
  const Entry& entry = handles_.at(handle, "body");
  return entry.role != BodyRole::kinematic && world().states().asleep[entry.number] != 0;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::wake(Handle handle) {
  clear_changes();
  const Entry& entry = handles_.at(handle, "body");
  if (asleep(handle)) note(sleeping_.set_moving(entry.number, SleepCause::user));
  return changes_;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::wake_all() {
  clear_changes();
  note(sleeping_.wake_all());
  return changes_;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::wake_near(const Box<Dim>& box) {
  clear_changes();
  require_finite(box.min(), "box.low");
  require_finite(box.max(), "box.high");
  if (box.isEmpty()) return changes_;
  Box<Dim> turned;
  turned.extend(turn_.in(box.min()));
  turned.extend(turn_.in(box.max()));
  note(sleeping_.wake(near(turned, sleeping_.extent()), SleepCause::lost_support));
  return changes_;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::moved(Handle handle, const Pose<Dim>& to) {
  clear_changes();
  const Entry& entry = handles_.at(handle, "body");
  check_pose<Dim>(to);
  const Box<Dim> before = bounds(entry);
  const double extent = (before.max() - before.min()).norm();
  std::vector<BodyIndex> neighbours = near(before, extent);
  if (entry.role == BodyRole::kinematic)
    kinematic_.place(entry.number, turn_.in(to));
  else
    note(sleeping_.set_moving(entry.number, SleepCause::user));
  note(sleeping_.wake(neighbours, SleepCause::lost_support));
  if (entry.role != BodyRole::kinematic) world().place(entry.number, turn_.in(to));
  note(sleeping_.wake(near(bounds(entry), extent), SleepCause::user));
  return changes_;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::set_gravity(const Vec<Dim>& gravity) {
  clear_changes();
  require_finite(gravity, "gravity");
  require(gravity_range.holds(gravity.stableNorm()), "gravity", gravity.stableNorm(), gravity_range.rule());
  note(sleeping_.set_gravity(turn_.in(gravity)));
  return changes_;
}

template <int Dim>
std::vector<SavedSleep> PileSleeper<Dim>::snapshot() const {
  std::vector<SavedSleep> saved;
  for (std::uint32_t slot = 0; slot < handles_.entries().size(); ++slot) {
    const Entry& entry = handles_.entries()[slot];
    if (!entry.present || entry.role == BodyRole::kinematic) continue;
    const bool asleep = world().states().asleep[entry.number] != 0 && !sleeping_.rests_on_awake(entry.number);
    saved.push_back({{slot, entry.generation}, asleep, asleep && sleeping_.settled(entry.number)});
  }
  return saved;
}

template <int Dim>
const SleepChanges<Dim>& PileSleeper<Dim>::restore(std::span<const SavedSleep> saved,
                                                   std::span<const Pose<Dim>> poses) {
  clear_changes();
  require(saved.size() == poses.size(), "poses", static_cast<double>(poses.size()), "must be as many as saved bodies");
  given_.resize(handles_.entries().size(), 0);
  ++steps_;
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const Entry& entry = handles_.at(saved[i].body, "saved body");
    require(!saved[i].asleep || entry.role == BodyRole::sleeps, "saved body", saved[i].body.slot,
            "must have the role of bodies that sleep, since it slept");
    std::int64_t& given = given_[saved[i].body.slot];
    require(given != steps_, "saved body", saved[i].body.slot, "must be there once");
    given = steps_;
    check_pose<Dim>(poses[i], fmt::format("poses[{}]", i));
  }
  note(sleeping_.wake_all());
  std::vector<BodyIndex> settled;
  std::vector<BodyIndex> others;
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const Entry& entry = handles_.at(saved[i].body, "saved body");
    if (entry.role == BodyRole::kinematic) continue;
    world().place(entry.number, turn_.in(poses[i]));
    sleeping_.set_moving(entry.number, SleepCause::user);
    if (saved[i].asleep && enabled_) (saved[i].settled ? settled : others).push_back(entry.number);
  }
  note(sleeping_.freeze_saved(settled, true));
  note(sleeping_.freeze_saved(others, false));
  return changes_;
}

template class PileSleeper<2>;
template class PileSleeper<3>;

}  // namespace talus
