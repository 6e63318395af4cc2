#include "common/simulation/rest_check.h"

#include <algorithm>
#include <cmath>

#include "common/policy/adaptive/rest_criterion.h"
#include "common/scene/typical_body.h"

namespace talus {

template <int Dim>
RestCheck<Dim>::RestCheck(const Scene<Dim>& scene) : distance_(rest_distance * typical_body(scene).extent) {
  constexpr double least_gravity = 1e-3;  // [m/s^2]; without gravity there is no such time
  const double time = rest_time * std::sqrt(typical_body(scene).extent / std::max(scene.world.gravity, least_gravity));
  const double frame = static_cast<double>(scene.steps_per_frame()) * scene.world.dt;
  period_ = scene.steps_per_frame() * std::max<std::int64_t>(1, std::llround(time / frame));
}

template <int Dim>
bool RestCheck<Dim>::update(const World<Dim>& world, std::int64_t step) {
  if (step % period_ != 0) return false;
  const bool rested = looked_ && has_rested(world);
  looked_ = true;
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
    return max_displacement(poses_[before - bodies_.begin()], world.states().pose[body], reach) <= distance_;
  });
}

template class RestCheck<2>;
template class RestCheck<3>;

}  // namespace talus
