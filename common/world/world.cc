#include "common/world/world.h"

#include <algorithm>

#include "common/math/require.h"
#include "common/world/stopwatch.h"

namespace talus {

template <int Dim>
World<Dim>::World(const WorldDescription<Dim>& description, const SpeedLimits& limits)
    : description_(description), limits_(limits) {
  check(description_);
}

template <int Dim>
BodyIndex World<Dim>::add(const BodyDef<Dim>& body) {
  check(body, description_);
  const BodyIndex index = states_.size();
  const Pose<Dim> pose = engine_add(index, body);
  states_.shape.push_back(body.shape);
  states_.pose.push_back(pose);
  states_.velocity.push_back(body.velocity);
  states_.spin.push_back(body.spin);
  states_.asleep.push_back(0);
  states_.removed.push_back(0);
  images_.push_back(body.image.value_or(Image{index, 0}));
  awake_.push_back(index);
  return index;
}

template <int Dim>
BodyIndex World<Dim>::add_unchecked(int shape, const Pose<Dim>& pose, std::optional<BodyIndex> number) {
  const BodyIndex body = number.value_or(states_.size());
  if (!number) {
    states_.shape.emplace_back();
    states_.pose.emplace_back();
    states_.velocity.emplace_back();
    states_.spin.emplace_back();
    states_.asleep.push_back(0);
    states_.removed.push_back(0);
  }
  states_.shape[body] = shape;
  states_.pose[body] = pose;
  states_.velocity[body].setZero();
  states_.spin[body].setZero();
  states_.asleep[body] = 0;
  states_.removed[body] = 0;
  awake_.insert(std::ranges::lower_bound(awake_, body), body);
  return body;
}

template <int Dim>
void World<Dim>::put_shape(int number, const Shape<Dim>& shape) {
  if (number == std::ssize(description_.shapes)) description_.shapes.emplace_back();
  description_.shapes[number] = shape;
  ++form_;
}

template <int Dim>
void World<Dim>::put_obstacle(int number, const Obstacle<Dim>& obstacle) {
  if (number == std::ssize(description_.obstacles)) description_.obstacles.emplace_back();
  description_.obstacles[number] = obstacle;
  if (!removed_obstacles_.empty()) removed_obstacles_.resize(description_.obstacles.size(), 0);
  if (!removed_obstacles_.empty()) removed_obstacles_[number] = 0;
  ++form_;
}

template <int Dim>
void World<Dim>::remove(std::span<const BodyIndex> bodies) {
  choose(bodies);
  if (chosen_.empty()) return;
  gather_contacts();
  removals_ += std::ssize(chosen_);
  for (const BodyIndex body : chosen_) states_.removed[body] = 1;
  std::erase_if(awake_, [this](BodyIndex body) { return states_.removed[body] != 0; });
  std::erase_if(pushes_, [this](const Push<Dim>& push) { return states_.removed[push.body] != 0; });
  engine_remove(chosen_);
  if (description_.engine_sleep) follow_engine_sleep();
}

template <int Dim>
void World<Dim>::step() {
  if (failure_) throw NonFiniteState(*failure_);
  ++steps_;
  contacts_.clear();
  contacts_wait_ = false;
  times_ = engine_step();
  pushes_.clear();
  if (!awake_.empty()) read_step();
  if (description_.debug.gather_contacts) gather_contacts();
  place_obstacles();
}

template <int Dim>
void World<Dim>::move_obstacle(int number, const Pose<Dim>& to) {
  require_obstacle(number);
  require(description_.obstacles[number].moves, "obstacle", number, "must be one that may move");
  // From the poses in double precision: those of an engine are too coarse for the difference of a short step.
  const Pose<Dim>& from = obstacle_pose(number);
  engine_move_obstacle(number, to, (to.position - from.position) / description_.dt,
                       spin_between<Dim>(from.rotation, to.rotation, description_.dt));
  moves_.emplace_back(number, to);
}

template <int Dim>
void World<Dim>::engine_move_obstacle(int number, const Pose<Dim>& /*to*/, const Vec<Dim>& /*velocity*/,
                                      const Spin<Dim>& /*spin*/) {
  require(false, "obstacle", number, "must stand still: this engine moves no obstacles");
}

template <int Dim>
void World<Dim>::set_surface_velocity(int number, const Vec<Dim>& velocity) {
  require_obstacle(number);
  require(description_.obstacles[number].moves, "obstacle", number, "must be one that may move");
  require(description_.solver.small_steps(), "surface velocity", velocity.norm(),
          "must be 0 unless the solver is small_steps");
  belts_.resize(description_.obstacles.size(), Vec<Dim>::Zero());
  belts_[number] = velocity;
}

template <int Dim>
void World<Dim>::remove_obstacle(int number) {
  require_obstacle(number);
  gather_contacts();
  std::erase_if(moves_, [number](const auto& move) { return move.first == number; });
  engine_remove_obstacle(number);
  removed_obstacles_.resize(description_.obstacles.size(), 0);
  removed_obstacles_[number] = 1;
}

template <int Dim>
void World<Dim>::restore_obstacle(int number, const Pose<Dim>& at) {
  require(number >= 0 && number < std::ssize(description_.obstacles) && !has_obstacle(number), "obstacle", number,
          "must be the number of an obstacle that was removed");
  description_.obstacles[number].pose = at;
  engine_restore_obstacle(number);
  removed_obstacles_[number] = 0;
}

template <int Dim>
void World<Dim>::engine_remove_obstacle(int number) {
  require(false, "obstacle", number, "must stay: this engine removes no obstacles");
}

template <int Dim>
void World<Dim>::set_gravity(const Vec<Dim>& gravity) {
  require(gravity.allFinite(), "gravity", gravity.norm(), "must be finite");
  engine_set_gravity(gravity);
  description_.set_gravity(gravity);
}

template <int Dim>
void World<Dim>::engine_set_gravity(const Vec<Dim>& gravity) {
  require(false, "gravity", gravity.norm(), "must stay: this engine does not change it");
}

template <int Dim>
void World<Dim>::require_obstacle(int number) const {
  require(number >= 0 && number < std::ssize(description_.obstacles), "obstacle", number,
          "must be the number of an obstacle, from 0 on");
  require(has_obstacle(number), "obstacle", number, "must not have been removed");
}

template <int Dim>
void World<Dim>::place_obstacles() {
  for (const auto& [number, pose] : moves_) {
    description_.obstacles[number].pose = pose;
    engine_place_obstacle(number, pose);
  }
  moves_.clear();
}

template <int Dim>
void World<Dim>::read_step() {
  Stopwatch watch;
  if (const std::optional<BodyIndex> broken = engine_read(states_)) {
    failure_.emplace(steps_, *broken);
    throw NonFiniteState(*failure_);
  }
  if (description_.engine_sleep) follow_engine_sleep();
  contacts_wait_ = record_contacts_;
  times_.read = watch.lap();
}

template <int Dim>
void World<Dim>::gather_contacts() const {
  if (contacts_wait_) engine_contacts(contacts_);
  contacts_wait_ = false;
}

template <int Dim>
void World<Dim>::place(BodyIndex body, const Pose<Dim>& pose) {
  require_present(body);
  require(states_.asleep[body] == 0, "body", body, "must be awake to be put elsewhere");
  check(BodyDef<Dim>{states_.shape[body], pose}, description_);
  gather_contacts();
  states_.pose[body] = engine_place(body, pose);
}

template <int Dim>
Pose<Dim> World<Dim>::engine_place(BodyIndex body, const Pose<Dim>& /*pose*/) {
  require(false, "body", body, "must stay where it is: this engine puts no bodies elsewhere");
  return {};
}

template <int Dim>
void World<Dim>::set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
  require_present(body);
  require(states_.asleep[body] == 0, "body", body, "must be awake to get a velocity");
  check(BodyDef<Dim>{states_.shape[body], {}, velocity, spin}, description_);
  engine_set_velocity(body, velocity, spin);
  states_.velocity[body] = velocity;
  states_.spin[body] = spin;
}

template <int Dim>
void World<Dim>::push(BodyIndex body, const Vec<Dim>& force) {
  require_present(body);
  require(states_.asleep[body] == 0, "body", body, "must be awake to be pushed");
  require(force.allFinite(), "force", force.norm(), "must be finite");
  require(description_.solver.small_steps(), "force", force.norm(), "must be 0 unless the solver is small_steps");
  pushes_.push_back({body, force});
}

template <int Dim>
void World<Dim>::set_grip(BodyIndex body, double grip) {
  require_present(body);
  require(grip >= 0.0 && std::isfinite(grip), "grip", grip, "must be >= 0 and finite");
  require(grip == 0.0 || description_.solver.small_steps(), "grip", grip, "must be 0 unless the solver is small_steps");
  engine_set_grip(body, grip);
  if (std::ssize(states_.grip) <= body) states_.grip.resize(body + 1, 0.0F);
  states_.grip[body] = static_cast<float>(grip);
}

template <int Dim>
void World<Dim>::engine_set_grip(BodyIndex /*body*/, double grip) {
  require(grip == 0.0, "grip", grip, "must be 0: the bodies of this engine have none");
}

template <int Dim>
void World<Dim>::freeze(std::span<const BodyIndex> bodies) {
  choose(bodies, false);
  if (chosen_.empty()) return;
  gather_contacts();
  for (const BodyIndex body : chosen_) stop(body);
  std::erase_if(pushes_, [this](const Push<Dim>& push) { return states_.asleep[push.body] != 0; });
  std::erase_if(awake_, [this](BodyIndex body) { return states_.asleep[body] != 0; });
  engine_freeze(chosen_);
  if (description_.engine_sleep) follow_engine_sleep();
}

template <int Dim>
void World<Dim>::thaw(std::span<const BodyIndex> bodies) {
  choose(bodies, true);
  if (chosen_.empty()) return;
  gather_contacts();
  for (const BodyIndex body : chosen_) states_.asleep[body] = 0;
  const auto middle = static_cast<std::ptrdiff_t>(awake_.size());
  awake_.insert(awake_.end(), chosen_.begin(), chosen_.end());
  std::inplace_merge(awake_.begin(), awake_.begin() + middle, awake_.end());
  engine_thaw(chosen_);
  if (description_.engine_sleep) follow_engine_sleep();
}

template <int Dim>
void World<Dim>::set_ring(const std::optional<SleepRing>& ring) {
  if (!ring && !has_ring_) return;
  if (ring) {
    require(description_.solver.small_steps(), "rings", ring->rings, "must be 0 unless the solver is small_steps");
    for (BodyIndex body = 0; body < states_.size(); ++body)
      require(states_.asleep[body] == 0 || states_.removed[body] != 0, "rings", ring->rings,
              "must be set while no body sleeps");
  }
  engine_set_ring(ring);
  has_ring_ = ring.has_value();
}

template <int Dim>
void World<Dim>::engine_set_ring(const std::optional<SleepRing>& ring) {
  if (ring) require(false, "rings", ring->rings, "must be 0: in this engine sleeping bodies feel nothing");
}

template <int Dim>
void World<Dim>::query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const {
  require(!box.min().hasNaN() && !box.max().hasNaN(), "box", "NaN", "must have corners that are numbers");
  if (box.isEmpty()) return;
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  engine_query_box(box, found);
  std::sort(found.begin() + before, found.end());
  found.erase(std::unique(found.begin() + before, found.end()), found.end());
}

template <int Dim>
void World<Dim>::require_present(BodyIndex body) const {
  require(body >= 0 && body < states_.size(), "body", body, "must be the number of a body added before, from 0 on");
  require(states_.removed[body] == 0, "body", body, "must not have been removed");
}

template <int Dim>
void World<Dim>::choose(std::span<const BodyIndex> bodies) {
  for (const BodyIndex body : bodies) require_present(body);
  chosen_.assign(bodies.begin(), bodies.end());
  std::ranges::sort(chosen_);
  chosen_.erase(std::unique(chosen_.begin(), chosen_.end()), chosen_.end());
}

template <int Dim>
void World<Dim>::choose(std::span<const BodyIndex> bodies, bool asleep) {
  choose(bodies);
  std::erase_if(chosen_, [&](BodyIndex body) { return (states_.asleep[body] != 0) != asleep; });
}

template <int Dim>
void World<Dim>::stop(BodyIndex body) {
  states_.asleep[body] = 1;
  states_.velocity[body].setZero();
  states_.spin[body].setZero();
}

/// Costs O(all bodies): the engine does not report which bodies its own rule put to sleep or woke.
template <int Dim>
void World<Dim>::follow_engine_sleep() {
  awake_.clear();
  for (BodyIndex body = 0; body < states_.size(); ++body) {
    if (states_.removed[body] != 0) continue;
    if (engine_awake(body)) {
      states_.asleep[body] = 0;
      awake_.push_back(body);
    } else {
      stop(body);
    }
  }
}

template class World<2>;
template class World<3>;

}  // namespace talus
