#include "common/simulation/rest_check.h"

#include <algorithm>
#include <cmath>

#include "common/policy/rest/rest_criterion.h"
#include "common/scene/typical_body.h"

namespace talus {

template <int Dim>
RestCheck<Dim>::RestCheck(const Scene<Dim>& scene)
    : extent_(typical_body(scene).extent),
      frame_time_(static_cast<double>(scene.steps_per_frame()) * scene.world.dt),
      steps_per_frame_(scene.steps_per_frame()) {}

/// [steps]
template <int Dim>
std::int64_t RestCheck<Dim>::period_in(const World<Dim>& world) const {
  const double time = rest_time * time_unit(extent_, world);
  return steps_per_frame_ * std::max<std::int64_t>(1, std::llround(time / frame_time_));
}

template <int Dim>
bool RestCheck<Dim>::update(const World<Dim>& world, std::int64_t step) {
  if (step % steps_per_frame_ != 0 || step - looked_at_ < period_in(world)) return false;
  const bool rested = looked_at_ > 0 && gravity_ == world.gravity() && has_rested(world);
  looked_at_ = step;
  gravity_ = world.gravity();
  bodies_.assign(world.awake().begin(), world.awake().end());
  poses_.clear();
  for (const BodyIndex body : bodies_) poses_.push_back(world.states().pose[body]);
  return rested;
}

template <int Dim>
bool RestCheck<Dim>::has_rested(const World<Dim>& world) const {
  return std::ranges::all_of(world.awake(), [&](BodyIndex body) {
    const auto before = std::ranges::lower_bound(bodies_, body);
    if (before == bodies_.end() || *before != body) return false;
    const double reach = 0.5 * world.shape_of(body).extent;
    return max_displacement(poses_[before - bodies_.begin()], world.states().pose[body], reach) <=
           rest_distance * extent_;
  });
}

template class RestCheck<2>;
template class RestCheck<3>;

}  // namespace talus
