#include "common/solver/ring.h"

#include <algorithm>

namespace talus {
namespace {

/// A sleeping body wakes when a point of it has moved farther than this since it fell asleep [D]: as far as one at rest
/// may move.
constexpr float wake_distance = 0.01F;
/// Or is faster than this, at which it would rise by that distance [sqrt(g D)].
constexpr float wake_share = 0.14F;
/// Or has come to rest in the ring farther than this from where it fell asleep [D]: the engine's pose must be updated.
constexpr float settle_distance = 0.002F;
/// While obstacles move, bodies that are faster than this share of the slowest count as moving: else what a slow one
/// carries would be held back by what has not begun to move.
constexpr float obstacle_share = 0.3F;
/// A body beyond the ring is solved if the forces on it have changed by more than this since its last solve [its
/// weight].
constexpr float balance = 0.01F;
/// Steps for which a body stays in the ring that does not reach it any more. Without, the ring's border moves to and
/// fro, and each move changes forces.
constexpr int hold_steps = 20;
/// Factor of the contacts by which the ring goes on from what an impact strikes, from one solve of a step to the next.
constexpr int widening = 4;
/// Of these contacts at most: more than any heap has from one side to the other.
constexpr int widest_ring = 1 << 12;
/// A body that has fallen asleep or was disturbed is solved for this time in any case [sqrt(D/g)]: at a turning point,
/// or as it begins to slide or to tip, it is slow for a moment, and has become faster than what is still by then.
constexpr float trial_time = 3.0F;

}  // namespace

template <int Dim>
void Ring<Dim>::put_to_sleep(BodyIndex body, const SolverBody<Dim>& state, float reach) {
  if (body >= std::ssize(sleepers_)) {
    sleepers_.resize(body + 1);
    listed_.resize(body + 1, 0);
  }
  Sleeper& sleeper = sleepers_[body];
  sleeper = {.body = state, .reach = reach, .asleep = true, .hold = hold_steps};
  sleeper.body.moves = true;
  sleeper.body.way.setZero();
  sleeper.body.turn.setZero();
  before_.push_back(body);
}

template <int Dim>
SolverBody<Dim> Ring<Dim>::wake(BodyIndex body, std::vector<SleepingPoint<Dim>>& released) {
  contacts_.release(body, released);
  SolverBody<Dim> state = sleepers_[body].body;
  sleepers_[body] = {};
  return state;
}

/// What loses a point is disturbed.
template <int Dim>
void Ring<Dim>::forget(BodyIndex side) {
  released_.clear();
  contacts_.release(side, released_);
  for (const SleepingPoint<Dim>& point : released_)
    for (const BodyIndex other : {point.a, point.b})
      if (other >= 0 && other != side) disturb(other);
  if (side >= 0 && has(side)) sleepers_[side] = {};
}

/// The body is solved in the next step, and on trial again.
template <int Dim>
void Ring<Dim>::disturb(BodyIndex body) {
  if (!has(body)) return;
  disturbed_.push_back(body);
  sleepers_[body].tried = 0.0F;
}

template <int Dim>
bool Ring<Dim>::touch(BodyIndex body, BodyIndex side) const {
  return has(body) && std::ranges::any_of(contacts_.of(body), [&](int number) {
           return contacts_[number].a == side || contacts_[number].b == side;
         });
}

template <int Dim>
float Ring<Dim>::reach() const {
  return 2.0F * wake_distance * static_cast<float>(params_.extent);
}

/// The ground has no list of its own: its points are found by their bodies.
template <int Dim>
void Ring<Dim>::append_contacts(BodyIndex side, const BodyStates<Dim>& states, double impulse_unit,
                                std::vector<Contact<Dim>>& out) const {
  const auto append = [&](std::span<const int> numbers) {
    for (const int number : numbers)
      if (const SleepingPoint<Dim>& point = contacts_[number];
          (point.a == side && point.b >= 0) || (point.b == side && point.a >= 0))
        out.push_back(contact_of(point, side, states, impulse_unit));
  };
  if (side != ground_index) {
    append(contacts_.of(side));
    return;
  }
  for (BodyIndex body = 0; body < std::ssize(sleepers_); ++body)
    if (sleepers_[body].asleep) append(contacts_.of(body));
}

template <int Dim>
Contact<Dim> Ring<Dim>::contact_of(const SleepingPoint<Dim>& point, BodyIndex side, const BodyStates<Dim>& states,
                                   double impulse_unit) const {
  const bool first = point.b == side;  // the body is the point's a, on which the opposite impulses act
  const double sign = first ? -1.0 : 1.0;
  const BodyIndex body = first ? point.a : point.b;
  const VecF<Dim>& arm = first ? point.contact.arm_a : point.contact.arm_b;
  return {.a = body,
          .b = side,
          .point = states.pose[body].position + arm.template cast<double>(),
          .normal = sign * point.contact.normal.template cast<double>(),
          .normal_impulse = impulse_unit * static_cast<double>(point.contact.normal_impulse),
          .friction_impulse = sign * impulse_unit * point.contact.friction_impulse.template cast<double>(),
          .depth = -static_cast<double>(point.contact.gap)};
}

template <int Dim>
bool Ring<Dim>::idle(std::span<const BodyIndex> moving) const {
  return members_.empty() && before_.empty() && disturbed_.empty() &&
         std::ranges::all_of(moving, [this](BodyIndex obstacle) { return contacts_.of(obstacle).empty(); });
}

template <int Dim>
void Ring<Dim>::start() {
  before_.insert(before_.end(), members_.begin(), members_.end());
  for (const BodyIndex body : before_)
    if (has(body)) --sleepers_[body].hold;
  stirred_.clear();
  last_touched_.swap(touched_);
  struck_.clear();
  beyond_struck_ = params_.rings;
  start_again();
}

template <int Dim>
void Ring<Dim>::start_again() {
  for (const BodyIndex body : border_) sleepers_[body].slot = 0;
  for (const BodyIndex body : members_) {
    sleepers_[body].slot = 0;
    sleepers_[body].left = -1;
  }
  border_.clear();
  members_.clear();
  entered_.clear();
  touched_.clear();
  slowest_obstacle_ = 0.0F;
}

template <int Dim>
int Ring<Dim>::join(BodyIndex body, ContactSolver<Dim>& solver) {
  if (sleepers_[body].slot == 0) touched_.push_back(body);
  enter(body, params_.rings - 1, solver);
  return sleepers_[body].slot;
}

template <int Dim>
void Ring<Dim>::enter(BodyIndex body, int left, ContactSolver<Dim>& solver) {
  if (!has(body)) return;
  Sleeper& sleeper = sleepers_[body];
  if (sleeper.left < 0) {
    sleeper.slot = solver.add(sleeper.body);
    members_.push_back(body);
  }
  if (left <= sleeper.left) return;
  sleeper.left = left;
  if (left > 0) entered_.push_back(body);
}

template <int Dim>
void Ring<Dim>::enter_partners(BodyIndex side, int left, ContactSolver<Dim>& solver) {
  for (const int number : contacts_.of(side)) {
    const SleepingPoint<Dim>& point = contacts_[number];
    const BodyIndex partner = point.a == side ? point.b : point.a;
    if (partner >= 0) enter(partner, left, solver);
  }
}

template <int Dim>
void Ring<Dim>::extend(ContactSolver<Dim>& solver, std::span<const int> obstacle_slots) {
  const int rings = params_.rings;
  for (const BodyIndex body : struck_) enter(body, beyond_struck_, solver);
  for (const BodyIndex body : moving_) enter(body, rings, solver);
  for (std::size_t i = 0; i < obstacle_slots.size(); ++i) {
    const BodyIndex obstacle = first_obstacle - static_cast<BodyIndex>(i);
    if (obstacle_slots[i] == 0 || contacts_.of(obstacle).empty()) continue;
    const SolverBody<Dim>& state = solver.body(obstacle_slots[i]);
    const float speed = state.velocity.norm() + static_cast<float>(params_.extent) * state.spin.norm();
    if (speed == 0.0F) continue;
    slowest_obstacle_ = slowest_obstacle_ > 0.0F ? std::min(slowest_obstacle_, speed) : speed;
    enter_partners(obstacle, rings - 1, solver);
  }
  for (const BodyIndex body : disturbed_) enter(body, rings - 1, solver);
  for (const BodyIndex body : last_touched_) enter(body, rings - 1, solver);
  std::size_t next = 0;  // the list grows meanwhile
  while (next < entered_.size()) {
    const BodyIndex body = entered_[next++];
    enter_partners(body, sleepers_[body].left - 1, solver);
  }
  hold_back(solver);
  first_point_ = solver.points().size();
  points_.clear();
  for (const BodyIndex body : members_) add_points(body, solver, obstacle_slots);
  for (const int number : points_) added_[number] = 0;
}

/// Keeps those of the step before that are no longer reached for a while. Where nothing moves none is kept but those on
/// trial.
template <int Dim>
void Ring<Dim>::hold_back(ContactSolver<Dim>& solver) {
  for (const BodyIndex body : members_) sleepers_[body].hold = hold_steps;
  const bool reached = !members_.empty();
  for (const BodyIndex body : before_)
    if (has(body) && sleepers_[body].left < 0 && ((reached && sleepers_[body].hold >= 0) || is_on_trial(body)))
      enter(body, 0, solver);
}

/// One that carries nothing yet has been put to sleep by the user.
template <int Dim>
bool Ring<Dim>::is_on_trial(BodyIndex body) const {
  return sleepers_[body].tried < trial_time && std::ranges::any_of(contacts_.of(body), [this](int number) {
           return contacts_[number].contact.normal_impulse > 0.0F;
         });
}

/// Bodies that were solved in the step before, but not in this one, come to rest where they are.
template <int Dim>
void Ring<Dim>::let_go() {
  for (const BodyIndex body : before_) {
    if (!has(body) || sleepers_[body].left >= 0) continue;
    Sleeper& sleeper = sleepers_[body];
    sleeper.body.velocity.setZero();
    sleeper.body.spin.setZero();
    if (far_of(sleeper) > settle_distance * static_cast<float>(params_.extent)) stirred_.push_back(body);
  }
  before_.clear();
}

template <int Dim>
void Ring<Dim>::add_points(BodyIndex body, ContactSolver<Dim>& solver, std::span<const int> obstacle_slots) {
  for (const int number : contacts_.of(body)) {
    if (number >= std::ssize(added_)) added_.resize(number + 1, 0);
    if (added_[number] != 0) continue;
    added_[number] = 1;
    const SleepingPoint<Dim>& kept = contacts_[number];
    ContactPoint<Dim> point = kept.contact;
    point.a = slot_of(kept.a, solver, obstacle_slots);
    point.b = slot_of(kept.b, solver, obstacle_slots);
    solver.add(point);
    points_.push_back(number);
  }
}

template <int Dim>
int Ring<Dim>::slot_of(BodyIndex side, ContactSolver<Dim>& solver, std::span<const int> obstacle_slots) {
  if (side == ground_index) return 0;
  if (side <= first_obstacle) return obstacle_slots[first_obstacle - side];
  Sleeper& sleeper = sleepers_[side];
  if (sleeper.slot == 0) {
    SolverBody<Dim> immovable = sleeper.body;
    immovable.moves = false;
    immovable.velocity.setZero();
    immovable.spin.setZero();
    sleeper.slot = solver.add(immovable);
    sleeper.struck.setZero();
    border_.push_back(side);
  }
  return sleeper.slot;
}

/// How far a point of it has moved at most [m].
template <int Dim>
float Ring<Dim>::far_of(const Sleeper& sleeper) {
  return sleeper.body.way.norm() + sleeper.reach * sleeper.body.turn.norm();
}

template <int Dim>
StepMotion<Dim> Ring<Dim>::shift(BodyIndex body) const {
  return has(body) ? sleepers_[body].body.motion() : StepMotion<Dim>{};
}

/// A sleeping body that is faster counts as moving [m/s].
template <int Dim>
float Ring<Dim>::still_speed(float gravity) const {
  return static_cast<float>(params_.still_speed * speed_unit(params_.extent, gravity));
}

template <int Dim>
bool Ring<Dim>::widen(const ContactSolver<Dim>& solver, float gravity) {
  if (border_.empty() || beyond_struck_ >= widest_ring) return false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint<Dim>& solved = solver.points()[first_point_ + i];
    const SleepingPoint<Dim>& kept = contacts_[points_[i]];
    const VecF<Dim> more = (solved.normal_sum - kept.contact.normal_impulse) * solved.normal + solved.friction_sum -
                           kept.contact.friction_impulse;
    if (kept.a >= 0 && sleepers_[kept.a].left < 0) sleepers_[kept.a].struck -= more;
    if (kept.b >= 0 && sleepers_[kept.b].left < 0) sleepers_[kept.b].struck += more;
  }
  const std::size_t known = struck_.size();
  const float still = still_speed(gravity);
  for (const BodyIndex body : border_)
    if (sleepers_[body].body.inverse_mass * sleepers_[body].struck.norm() > still) struck_.push_back(body);
  if (struck_.size() == known) return false;
  beyond_struck_ *= widening;
  return true;
}

template <int Dim>
void Ring<Dim>::read(const ContactSolver<Dim>& solver, float gravity, float dt) {
  const auto extent = static_cast<float>(params_.extent);
  const float distance = wake_distance * extent;
  const float tried = dt / static_cast<float>(time_unit(params_.extent, gravity));
  const float fast = wake_share * static_cast<float>(speed_unit(params_.extent, gravity));
  float still = still_speed(gravity);
  if (slowest_obstacle_ > 0.0F) still = std::min(still, obstacle_share * slowest_obstacle_);
  let_go();
  moving_.clear();
  disturbed_.clear();
  for (const BodyIndex body : members_) {
    Sleeper& sleeper = sleepers_[body];
    const SolverBody<Dim>& solved = solver.body(sleeper.slot);
    sleeper.body.velocity = solved.velocity;
    sleeper.body.spin = solved.spin;
    sleeper.body.way += solved.way;
    sleeper.body.turn += solved.turn;
    sleeper.tried += tried;
    const float speed = solved.velocity.norm() + sleeper.reach * solved.spin.norm();
    if (speed > fast || far_of(sleeper) > distance) stirred_.push_back(body);
    if (speed > still) moving_.push_back(body);
  }
  read_points(solver, distance);
  for (const BodyIndex body : members_) sleepers_[body].unsolved.setZero();
  disturb_unbalanced(balance * gravity * dt);
  std::ranges::sort(stirred_);
  stirred_.erase(std::unique(stirred_.begin(), stirred_.end()), stirred_.end());
}

/// A point on ground or an obstacle that has slid farther than `distance` has left its place: its body wakes.
template <int Dim>
void Ring<Dim>::read_points(const ContactSolver<Dim>& solver, float distance) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint<Dim>& solved = solver.points()[first_point_ + i];
    SleepingPoint<Dim>& kept = contacts_[points_[i]];
    const VecF<Dim> moved =
        solver.body(solved.b).motion().of(solved.arm_b) - solver.body(solved.a).motion().of(solved.arm_a);
    add_unsolved(kept, solved);
    kept.contact = solved;
    kept.contact.gap += solved.normal.dot(moved);
    if (kept.a >= 0 && kept.b >= 0) continue;
    kept.slip += along_plane<VecF<Dim>>(moved, solved.normal);
    if (kept.slip.norm() > distance) stirred_.push_back(std::max(kept.a, kept.b));
  }
}

/// Adds the change of a point's impulses to those of its bodies that were immovable in the solve.
template <int Dim>
void Ring<Dim>::add_unsolved(const SleepingPoint<Dim>& before, const ContactPoint<Dim>& solved) {
  const auto impulse = [](const ContactPoint<Dim>& point) -> VecF<Dim> {
    return point.normal_impulse * point.normal + point.friction_impulse;
  };
  const VecF<Dim> more = impulse(solved) - impulse(before.contact);
  for (const BodyIndex side : {before.a, before.b}) {
    if (side < 0 || sleepers_[side].left >= 0) continue;
    VecF<Dim>& unsolved = sleepers_[side].unsolved;
    if (listed_[side] == 0) unsolved_.push_back(side);
    listed_[side] = 1;
    unsolved += side == before.b ? more : VecF<Dim>(-more);
  }
}

template <int Dim>
void Ring<Dim>::disturb_unbalanced(float impulse_of_unit_mass) {
  std::erase_if(unsolved_, [&](BodyIndex body) {
    if (has(body) && !sleepers_[body].unsolved.isZero(0.0F)) return false;
    listed_[body] = 0;
    return true;
  });
  std::ranges::sort(unsolved_);
  for (const BodyIndex body : unsolved_) {
    const SolverBody<Dim>& state = sleepers_[body].body;
    if (state.inverse_mass * sleepers_[body].unsolved.norm() > impulse_of_unit_mass) disturb(body);
  }
}

template class Ring<2>;
template class Ring<3>;

}  // namespace talus
