#include "common/measure/load_meter.h"

#include <algorithm>

#include "common/shape/rigid_impulse.h"

namespace talus {
namespace {

bool any_asleep(std::span<const std::uint8_t> asleep, std::span<const std::uint8_t> removed) {
  for (std::size_t i = 0; i < asleep.size(); ++i)
    if (asleep[i] != 0 && removed[i] == 0) return true;
  return false;
}

template <int Dim>
std::vector<BodyIndex> sides_of(const Scene<Dim>& scene, const LoadParams<Dim>& params) {
  std::vector<BodyIndex> sides;
  if (params.on_ground) sides.push_back(ground_index);
  for (const int obstacle : params.obstacles) {
    const ObstacleName& named = scene.obstacle_names[obstacle];
    for (int k = named.first; k < named.first + named.count; ++k) sides.push_back(first_obstacle - k);
  }
  return sides;
}

}  // namespace

template <int Dim>
void LoadSpan<Dim>::add(const Wrench<Dim>& value) {
  least = steps == 0 ? value : Wrench<Dim>(least.cwiseMin(value));
  most = steps == 0 ? value : Wrench<Dim>(most.cwiseMax(value));
  ++steps;
  mean += (value - mean) / static_cast<double>(steps);
}

template <int Dim>
LoadMeter<Dim>::LoadMeter(const Scene<Dim>& scene, const LoadParams<Dim>& params)
    : LoadMeter(scene, sides_of(scene, params), params) {}

template <int Dim>
LoadMeter<Dim>::LoadMeter(const Scene<Dim>& scene) : LoadMeter(scene, {ground_index}, {}) {
  for (BodyIndex k = 0; k < std::ssize(scene.world.obstacles); ++k) sides_.push_back(first_obstacle - k);
  std::ranges::sort(sides_);
}

template <int Dim>
LoadMeter<Dim>::LoadMeter(const Scene<Dim>& scene, std::vector<BodyIndex> sides, const LoadParams<Dim>& params)
    : sides_(std::move(sides)),
      about_(params.about),
      heights_(params.heights),
      profile_(heights_.empty() ? 0 : heights_.size() - 1, Vec<Dim>::Zero()),
      next_profile_(profile_),
      dt_(scene.world.dt) {
  std::ranges::sort(sides_);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].asleep) asleep_from_start_.push_back(static_cast<BodyIndex>(i));
}

template <int Dim>
void LoadMeter<Dim>::update(const World<Dim>& world) {
  if (!all_forces_known(world)) {
    whole_.known = false;
    next_frame_.known = false;
  }
  Wrench<Dim> sum = Wrench<Dim>::Zero();
  add(world.contacts(), sum);
  sleeping_.clear();
  for (const BodyIndex side : sides_) world.sleeping_contacts(side, sleeping_);
  add(sleeping_, sum);
  sum /= dt_;
  whole_.add(sum);
  next_frame_.add(sum);
}

template <int Dim>
void LoadMeter<Dim>::end_frame() {
  if (next_frame_.steps == 0) return;
  const double time = static_cast<double>(next_frame_.steps) * dt_;
  for (std::size_t i = 0; i < profile_.size(); ++i) {
    profile_[i] = next_profile_[i] / time;
    next_profile_[i].setZero();
  }
  frame_ = next_frame_;
  next_frame_ = {};
}

template <int Dim>
bool LoadMeter<Dim>::all_forces_known(const World<Dim>& world) {
  const BodyStates<Dim>& states = world.states();
  std::erase_if(asleep_from_start_,
                [&](BodyIndex body) { return states.asleep[body] == 0 || states.removed[body] != 0; });
  if (!asleep_from_start_.empty()) {
    reason_ = "bodies that sleep from the start have no known forces";
    return false;
  }
  if (world.has_ring() || !any_asleep(states.asleep, states.removed)) return true;
  reason_ =
      "bodies slept, whose forces are kept only with world.solver.kind = \"small_steps\" and policy.adaptive.rings "
      "above 0";
  return false;
}

template <int Dim>
void LoadMeter<Dim>::add(std::span<const Contact<Dim>> contacts, Wrench<Dim>& sum) {
  for (const Contact<Dim>& contact : contacts) {
    if (!std::ranges::binary_search(sides_, contact.b)) continue;
    const Vec<Dim> impulse = -(contact.normal_impulse * contact.normal + contact.friction_impulse);
    sum.template head<Dim>() += impulse;
    sum.template tail<Wrench<Dim>::RowsAtCompileTime - Dim>() += moment(Vec<Dim>(contact.point - about_), impulse);
    if (heights_.empty()) continue;
    const auto above = std::ranges::upper_bound(heights_, height<Dim>(contact.point));
    if (above != heights_.begin() && above != heights_.end()) next_profile_[above - heights_.begin() - 1] += impulse;
  }
}

template struct LoadSpan<2>;
template struct LoadSpan<3>;
template class LoadMeter<2>;
template class LoadMeter<3>;

}  // namespace talus
