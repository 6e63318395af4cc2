#include "common/policy/rest_watch.h"

#include <algorithm>
#include <cmath>

namespace talus {

template <int Dim>
double farthest_move(const Pose<Dim>& from, const Pose<Dim>& to, double reach) {
  double turn = 0.0;
  if constexpr (Dim == 2) {
    turn = std::abs(to.rotation.angle() - from.rotation.angle());
  } else {
    // |sin| of half the angle is at least the length of the difference's vector part.
    turn = 2.0 * (from.rotation.conjugate() * to.rotation).vec().norm();
  }
  return (to.position - from.position).norm() + reach * turn;
}

template <int Dim>
RestWatch<Dim>::RestWatch(double distance, const std::vector<Shape<Dim>>& shapes) : distance_(distance) {
  for (const Shape<Dim>& shape : shapes) reach_.push_back(0.5 * shape.extent);
}

template <int Dim>
void RestWatch<Dim>::update(std::int64_t step, const BodyStates<Dim>& states, std::span<const BodyIndex> awake) {
  anchors_.resize(states.shape.size());
  for (const BodyIndex body : awake) {
    const auto i = static_cast<std::size_t>(body);
    Anchor& anchor = anchors_[i];
    const double reach = reach_[static_cast<std::size_t>(states.shape[i])];
    if (anchor.seen != step - 1 || farthest_move(anchor.pose, states.pose[i], reach) > distance_) {
      anchor = {.pose = states.pose[i], .since = step};
    }
    anchor.seen = step;
  }
}

template class RestWatch<2>;
template class RestWatch<3>;
template double farthest_move(const Pose<2>&, const Pose<2>&, double);
template double farthest_move(const Pose<3>&, const Pose<3>&, double);

}  // namespace talus
