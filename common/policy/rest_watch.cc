#include "common/policy/rest_watch.h"

#include <algorithm>
#include <cassert>
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
RestWatch<Dim>::RestWatch(double distance, double distance_woken, const std::vector<Shape<Dim>>& shapes)
    : distance_(distance), distance_woken_(distance_woken) {
  for (const Shape<Dim>& shape : shapes) reach_.push_back(0.5 * shape.extent);
}

template <int Dim>
void RestWatch<Dim>::update(std::int64_t step, const BodyStates<Dim>& states, std::span<const BodyIndex> awake) {
  last_anchors_.swap(anchors_);
  anchors_.clear();
  if (last_step_ != step - 1) last_anchors_.clear();  // after a gap all rest begins anew
  last_step_ = step;
  auto last = last_anchors_.begin();
  for (const BodyIndex body : awake) {
    const auto i = static_cast<std::size_t>(body);
    const double reach = reach_[static_cast<std::size_t>(states.shape[i])];
    while (last != last_anchors_.end() && last->body < body) ++last;
    const bool known = last != last_anchors_.end() && last->body == body;
    const double strayed = known ? farthest_move(last->pose, states.pose[i], reach) : 0.0;
    if (known && strayed <= distance_) {
      anchors_.push_back(*last);
      anchors_.back().slept = last->slept && strayed <= distance_woken_;
    } else {
      const bool woke = !known && body < last_count_ && !std::ranges::binary_search(expected_, body);
      anchors_.push_back({.body = body, .pose = states.pose[i], .since = step, .slept = woke});
    }
  }
  last_count_ = states.size();
  expected_.clear();
}

template <int Dim>
void RestWatch<Dim>::expect_to_move(std::span<const BodyIndex> bodies) {
  expected_.assign(bodies.begin(), bodies.end());
}

template <int Dim>
std::int64_t RestWatch<Dim>::steps_at_rest(std::int64_t step, BodyIndex body) const {
  return step - anchor_of(body).since;
}

template <int Dim>
bool RestWatch<Dim>::slept_here(BodyIndex body) const {
  return anchor_of(body).slept;
}

template <int Dim>
const typename RestWatch<Dim>::Anchor& RestWatch<Dim>::anchor_of(BodyIndex body) const {
  const auto anchor = std::ranges::lower_bound(anchors_, body, {}, &Anchor::body);
  assert(anchor != anchors_.end() && anchor->body == body);
  return *anchor;
}

template class RestWatch<2>;
template class RestWatch<3>;
template double farthest_move(const Pose<2>&, const Pose<2>&, double);
template double farthest_move(const Pose<3>&, const Pose<3>&, double);

}  // namespace talus
