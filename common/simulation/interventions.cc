#include "common/simulation/interventions.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "common/policy/near_bodies.h"
#include "common/scene/typical_body.h"

namespace talus {
namespace {

template <int Dim>
std::vector<BodyIndex> all_bodies(const World<Dim>& world) {
  std::vector<BodyIndex> all(world.states().shape.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <int Dim>
std::vector<BodyIndex> bodies_meant(const World<Dim>& world, const Event<Dim>& event) {
  const BodyStates<Dim>& states = world.states();
  const auto meant = [&](BodyIndex body) {
    const Vec<Dim>& at = states.pose[body].position;
    return states.removed[body] == 0 &&
           (event.shapes.empty() || std::ranges::count(event.shapes, states.shape[body]) > 0) &&
           (event.numbers.empty() || std::ranges::count(event.numbers, static_cast<double>(body)) > 0) &&
           (event.box.empty() || Box<Dim>(event.box[0], event.box[1]).contains(at));
  };
  std::vector<BodyIndex> bodies = all_bodies(world);
  std::erase_if(bodies, [&](BodyIndex body) { return !meant(body); });
  return bodies;
}

}  // namespace

template <int Dim>
Interventions<Dim>::Interventions(const Scene<Dim>& scene)
    : dt_(scene.world.dt),
      extent_(typical_body(scene).extent),
      events_(scene.events),
      obstacle_names_(scene.obstacle_names),
      clock_(scene.events),
      obstacles_(scene),
      gravity_motion_(scene.gravity_motion),
      gravity_(scene.world.gravity_vector()),
      gravity_change_(gravity_, extent_) {}

template <int Dim>
void Interventions<Dim>::do_due_events(const Intervened<Dim>& run, bool at_rest, std::span<const Pile<Dim>> piles) {
  for (const int number : clock_.update(run.time, run.emitter.emitted(), at_rest, piles)) {
    const std::optional<int> bodies = act(run, events_[number]);
    done_events_.push_back({number, run.time, bodies});
  }
}

template <int Dim>
void Interventions<Dim>::move(const Intervened<Dim>& run) {
  time_ = run.time;
  run.sleep.wake(obstacles_.move(run.world, run.time), SleepCause::lost_support);
  if (gravity_motion_) change_gravity(run);
  held_awake_.clear();
  if (pull_) pull_body(run);
  push_bodies(run);
}

/// Sleeping bodies do not feel that gravity changes: once it has by more than a little, all wake.
template <int Dim>
void Interventions<Dim>::change_gravity(const Intervened<Dim>& run) {
  const Vec<Dim> now = gravity_motion_->turn_at(run.time) * (gravity_ + gravity_motion_->shift_at(run.time));
  run.world.set_gravity(now);
  if (gravity_change_.wakes(now)) wake_for_gravity(run);
}

template <int Dim>
void Interventions<Dim>::wake_for_gravity(const Intervened<Dim>& run) {
  gravity_change_.note_wake(run.world.gravity(), run.time);
  run.sleep.wake(all_bodies(run.world), SleepCause::user);
}

template <int Dim>
bool Interventions<Dim>::must_stay_awake(const World<Dim>& world, BodyIndex body) const {
  return gravity_change_.keeps_awake(time_) || std::ranges::binary_search(held_awake_, body) ||
         obstacles_.keep_awake(world, body);
}

template <int Dim>
bool Interventions<Dim>::changes_after(const World<Dim>& world, double time) const {
  const auto ends_later = [&](const TimedPush& push) { return push.end && *push.end > time; };
  return obstacles_.moves_after(world, time) || (gravity_motion_ && gravity_motion_->moves_after(time)) ||
         std::ranges::any_of(pushes_, ends_later);
}

/// Sleeping neighbours are woken: neither the loss of a support nor a slow push wakes a body by itself.
template <int Dim>
void Interventions<Dim>::pull_body(const Intervened<Dim>& run) {
  const BodyIndex body = pull_->body;
  if (run.world.states().removed[body] != 0) {
    release();
    return;
  }
  held_awake_ = bodies_near<Dim>(run.world, run.world.bounds_of(body), waking_reach * run.world.shape_of(body).extent);
  run.sleep.wake(held_awake_, SleepCause::user);
  const VelocityChange<Dim> change = pulled(run.world, *pull_, dt_);
  run.world.set_velocity(body, change.velocity, change.spin);
}

template <int Dim>
void Interventions<Dim>::push_bodies(const Intervened<Dim>& run) {
  std::erase_if(pushes_, [&](const TimedPush& push) {
    return (push.end && run.time >= *push.end - time_rounding) || run.world.states().removed[push.push.body] != 0;
  });
  for (const TimedPush& each : pushes_) {
    const BodyIndex body = each.push.body;
    if (run.world.states().asleep[body] != 0) run.sleep.wake({&body, 1}, SleepCause::user);
    run.world.push(body, each.push.force);
    held_awake_.insert(std::ranges::upper_bound(held_awake_, body), body);
  }
}

template <int Dim>
std::optional<int> Interventions<Dim>::act(const Intervened<Dim>& run, const Event<Dim>& event) {
  switch (event.action) {
    case EventAction::remove:
      if (!event.obstacle) return act_on_bodies(run, event);
      for (const int number : obstacles_named(event))
        if (run.world.has_obstacle(number)) cut_obstacle(run, number);
      break;
    case EventAction::force:
    case EventAction::wake:
    case EventAction::kick:
      return act_on_bodies(run, event);
    case EventAction::add:
      add(run, event);
      break;
    case EventAction::rate:
      run.emitter.set_rate(event.source, event.rate, run.time);
      break;
    case EventAction::policy:
      run.switch_policy(event.policy);
      break;
    case EventAction::gravity:
      run.world.set_gravity(event.gravity);
      wake_for_gravity(run);
      break;
    case EventAction::picture:
      break;
  }
  return std::nullopt;
}

template <int Dim>
int Interventions<Dim>::act_on_bodies(const Intervened<Dim>& run, const Event<Dim>& event) {
  const std::vector<BodyIndex> bodies = bodies_meant(run.world, event);
  if (event.action == EventAction::wake) run.sleep.wake(bodies, SleepCause::user);
  if (event.action == EventAction::kick) kick(run, event, bodies);
  if (event.action == EventAction::remove) remove(run, bodies);
  if (event.action == EventAction::force) {
    const std::optional<double> end = event.seconds ? std::optional(run.time + *event.seconds) : std::nullopt;
    for (const BodyIndex body : bodies) pushes_.push_back({{body, event.force}, end});
  }
  return static_cast<int>(bodies.size());
}

template <int Dim>
void Interventions<Dim>::take_out_absent(const Scene<Dim>& scene, World<Dim>& world) {
  const std::vector<std::uint8_t> absent = absent_obstacles(scene, {}, 0.0);
  for (std::size_t k = 0; k < absent.size(); ++k)
    if (absent[k] != 0) world.remove_obstacle(static_cast<int>(k));
}

template <int Dim>
void Interventions<Dim>::add(const Intervened<Dim>& run, const Event<Dim>& event) const {
  if (!event.obstacle) return run.emitter.start(event.source, run.time);
  for (const int number : obstacles_named(event)) {
    if (run.world.has_obstacle(number)) continue;
    const Pose<Dim> at = obstacles_.pose_at(run.world, number, run.time);
    run.world.restore_obstacle(number, at);
    run.sleep.wake(bodies_near<Dim>(run.world, bounds_at(run.world.obstacle_shape(number), at), 0.0), SleepCause::user);
  }
}

template <int Dim>
std::vector<int> Interventions<Dim>::obstacles_named(const Event<Dim>& event) const {
  const ObstacleName& name = obstacle_names_[*event.obstacle];
  std::vector<int> numbers(name.count);
  std::iota(numbers.begin(), numbers.end(), name.first);
  return numbers;
}

template <int Dim>
void Interventions<Dim>::remove(const Intervened<Dim>& run, std::span<const BodyIndex> bodies) const {
  for (const BodyIndex body : bodies) run.world.require_present(body);
  std::vector<BodyIndex> near;
  for (const BodyIndex body : bodies) {
    const double reach = waking_reach * run.world.shape_of(body).extent;
    std::ranges::copy(sleepers_by(run.world, body, run.world.bounds_of(body), reach), std::back_inserter(near));
  }
  run.sleep.remove(bodies);
  run.sleep.wake(near, SleepCause::lost_support);
}

/// Those near a body or an obstacle, which is about to go, but for those that will feel it.
template <int Dim>
std::vector<BodyIndex> Interventions<Dim>::sleepers_by(const World<Dim>& world, BodyIndex side, const Box<Dim>& bounds,
                                                       double reach) {
  std::vector<BodyIndex> near = bodies_near<Dim>(world, bounds, reach);
  std::erase_if(near, [&](BodyIndex body) { return body == side || world.feels(body, side); });
  return near;
}

template <int Dim>
void Interventions<Dim>::cut_obstacle(const Intervened<Dim>& run, int number) const {
  const Box<Dim> bounds = bounds_at(run.world.obstacle_shape(number), run.world.obstacle_pose(number));
  const std::vector<BodyIndex> near = sleepers_by(run.world, first_obstacle - number, bounds, waking_reach * extent_);
  run.world.remove_obstacle(number);
  run.sleep.wake(near, SleepCause::lost_support);
}

/// The sum may be no faster than the engine allows.
template <int Dim>
void Interventions<Dim>::kick(const Intervened<Dim>& run, const Event<Dim>& event,
                              std::span<const BodyIndex> bodies) const {
  run.sleep.wake(bodies, SleepCause::user);
  const BodyStates<Dim>& states = run.world.states();
  for (const BodyIndex body : bodies) {
    const Vec<Dim> velocity = states.velocity[body] + event.velocity;
    const Spin<Dim> spin = states.spin[body] + event.spin;
    run.world.set_velocity(body, limited(velocity, fastest_speed<Dim>(dt_, run.world.units())),
                           limited(spin, fastest_spin(dt_)));
  }
}

template class Interventions<2>;
template class Interventions<3>;

}  // namespace talus
