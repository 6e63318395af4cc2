#include "common/simulation/energy_ledger.h"

#include <algorithm>

#include "common/world/energy.h"

namespace talus {
namespace {

constexpr double tolerated_share = 0.1;
constexpr double tolerated_burst = 0.02;  // of the work that lifts each awake body by its own extent
constexpr double rest_speed = 0.5;        // in the units of the engine [m/s]; without gravity the only scale of rest

}  // namespace

template <int Dim>
EnergyLedger<Dim>::EnergyLedger(const WorldDescription<Dim>& world) : dt_(world.dt) {
  for (int k = 0; k < std::ssize(world.obstacles); ++k)
    if (world.obstacles[k].moves) obstacles_.push_back({k, {}});
}

template <int Dim>
void EnergyLedger<Dim>::start_step(const World<Dim>& world) {
  const BodyStates<Dim>& states = world.states();
  before_.clear();
  for (const BodyIndex body : world.awake())
    before_.push_back(
        {body, states.pose[body].position, states.velocity[body], kinetic_energy(world, body), world.gravity()});
  for (const Push<Dim>& push : world.pushes())
    std::ranges::lower_bound(before_, push.body, {}, &Before::body)->acceleration +=
        push.force / world.shape_of(push.body).mass;
  for (ObstacleBefore& obstacle : obstacles_) obstacle.pose = world.obstacle_pose(obstacle.number);
}

template <int Dim>
void EnergyLedger<Dim>::end_step(const World<Dim>& world) {
  change_ = gain_ = kinetic_ = lift_ = 0.0;
  for (const Before& before : before_) add(world, before);
  work_ = work_of_obstacles(world);
  largest_kinetic_ = std::max(largest_kinetic_, kinetic_);
  largest_lift_ = std::max(largest_lift_, lift_);
  const double given_back = std::clamp(-work_, 0.0, held_);
  held_ = std::max(0.0, work_);
  rise_ = std::max(0.0, rise_ + change_ - work_ - given_back);
  if (burst_ == 0.0) burst_lift_ = 0.0;
  burst_lift_ = std::max(burst_lift_, lift_);
  burst_ = std::max(0.0, burst_ + gain_ - work_ - given_back);
}

template <int Dim>
void EnergyLedger<Dim>::add(const World<Dim>& world, const Before& before) {
  const Shape<Dim>& shape = world.shape_of(before.body);
  const Vec<Dim>& acceleration = before.acceleration;
  const double kinetic = kinetic_energy(world, before.body);
  const double gained = kinetic - before.kinetic;
  change_ +=
      gained - shape.mass * acceleration.dot(world.pose_near(before.body, before.position).position - before.position);
  gain_ += gained - shape.mass * dt_ * acceleration.dot(before.velocity + 0.5 * dt_ * acceleration);
  kinetic_ += kinetic;
  const double slow = rest_speed / world.units().speeds();
  lift_ += shape.mass * (world.gravity_size() * shape.extent + 0.5 * slow * slow);
}

/// Sleeping bodies that feel forces pass on to awake ones what an obstacle does to them. Where it lowers them they lose
/// energy, which is in no sum here.
template <int Dim>
double EnergyLedger<Dim>::work_of_obstacles(const World<Dim>& world) {
  double work = 0.0;
  if (!obstacles_.empty())
    for (const Contact<Dim>& contact : world.contacts()) work += work_of(world, contact);
  sleeping_.clear();
  for (const ObstacleBefore& before : obstacles_) world.sleeping_contacts(first_obstacle - before.number, sleeping_);
  double on_sleepers = 0.0;
  for (const Contact<Dim>& contact : sleeping_) on_sleepers += work_of(world, contact);
  return work + std::max(0.0, on_sleepers);
}

template <int Dim>
double EnergyLedger<Dim>::work_of(const World<Dim>& world, const Contact<Dim>& contact) const {
  if (contact.b > first_obstacle) return 0.0;
  const auto before = std::ranges::lower_bound(obstacles_, first_obstacle - contact.b, {}, &ObstacleBefore::number);
  if (before == obstacles_.end() || before->number != first_obstacle - contact.b) return 0.0;
  const Pose<Dim>& after = world.obstacle_pose(before->number);
  const Vec<Dim> own = before->pose.rotation.inverse() * (contact.point - before->pose.position);
  const auto belt = along_plane<Vec<Dim>>(world.surface_velocity(before->number), contact.normal);
  const Vec<Dim> moved = after.position + after.rotation * own - contact.point + dt_ * belt;
  return (contact.normal_impulse * contact.normal + contact.friction_impulse).dot(moved) / dt_;
}

template <int Dim>
double EnergyLedger<Dim>::tolerance() const {
  return tolerated_share * (largest_kinetic_ + largest_lift_);
}

template <int Dim>
double EnergyLedger<Dim>::burst_tolerance() const {
  return tolerated_share * largest_kinetic_ + tolerated_burst * burst_lift_;
}

template class EnergyLedger<2>;
template class EnergyLedger<3>;

}  // namespace talus
