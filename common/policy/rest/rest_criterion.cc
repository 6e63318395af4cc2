#include "common/policy/rest/rest_criterion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/math/angle.h"

namespace talus {

template <int Dim>
double max_displacement(const Pose<Dim>& from, const Pose<Dim>& to, double reach) {
  double turn = 0.0;
  if constexpr (Dim == 2) {
    turn = std::abs(wrapped(to.rotation.angle() - from.rotation.angle()));
  } else {
    // The vector part of the relative rotation is the sine of half the angle; the arc is at most twice that chord.
    turn = 2.0 * (from.rotation.conjugate() * to.rotation).vec().norm();
  }
  return (to.position - from.position).norm() + reach * turn;
}

template <int Dim>
RestCriterion<Dim>::RestCriterion(const RuleSetup<Dim>& setup)
    : distance_(setup.params.rest_distance_factor() * setup.params.rest_distance * setup.typical.extent),
      distance_woken_(setup.params.rest_distance_factor() * setup.params.rest_distance_woken * setup.typical.extent) {}

template <int Dim>
void RestCriterion<Dim>::update(const RuleInput<Dim>& in) {
  last_references_.swap(references_);
  references_.clear();
  if (last_step_ != in.step - 1) last_references_.clear();  // after a gap every rest begins again
  last_step_ = in.step;
  time_ += in.world.dt();
  auto last = last_references_.begin();
  for (const BodyIndex body : in.world.awake()) {
    const Pose<Dim>& pose = in.pose_of(body);
    const double reach = 0.5 * in.shape_of(body).extent;
    while (last != last_references_.end() && last->body < body) ++last;
    const bool was_awake = last != last_references_.end() && last->body == body;
    const double moved = was_awake ? max_displacement(last->pose, pose, reach) : 0.0;
    if (was_awake && moved <= distance_) {
      references_.push_back(*last);
      references_.back().unmoved_since_wake = last->unmoved_since_wake && moved <= distance_woken_;
    } else {
      const bool woke = !was_awake && body < last_count_;
      const bool unmoved = woke && !std::ranges::binary_search(expected_to_move_, body);
      references_.push_back({.body = body, .pose = pose, .since = time_, .unmoved_since_wake = unmoved});
    }
  }
  last_count_ = in.states().size();
  expected_to_move_.clear();
}

/// A new body has not rested before, so it is expected to move.
template <int Dim>
void RestCriterion<Dim>::forget(BodyIndex body) {
  const auto is_of_body = [body](const Reference& reference) { return reference.body == body; };
  std::erase_if(references_, is_of_body);
  std::erase_if(last_references_, is_of_body);
  expected_to_move_.insert(std::ranges::lower_bound(expected_to_move_, body), body);
}

template <int Dim>
void RestCriterion<Dim>::expect_motion(const WakeList& wakes) {
  expected_to_move_.clear();
  for (const auto& [body, wake] : wakes)
    if (wake.before_impact) expected_to_move_.push_back(body);
}

template <int Dim>
double RestCriterion<Dim>::time_at_rest(BodyIndex body) const {
  return time_ - reference_of(body).since;
}

template <int Dim>
bool RestCriterion<Dim>::watches(BodyIndex body) const {
  return std::ranges::binary_search(references_, body, {}, &Reference::body);
}

template <int Dim>
bool RestCriterion<Dim>::was_awake(BodyIndex body) const {
  return std::ranges::binary_search(last_references_, body, {}, &Reference::body);
}

template <int Dim>
bool RestCriterion<Dim>::unmoved_since_wake(BodyIndex body) const {
  return reference_of(body).unmoved_since_wake;
}

template <int Dim>
const typename RestCriterion<Dim>::Reference& RestCriterion<Dim>::reference_of(BodyIndex body) const {
  const auto reference = std::ranges::lower_bound(references_, body, {}, &Reference::body);
  assert(reference != references_.end() && reference->body == body);
  return *reference;
}

template class RestCriterion<2>;
template class RestCriterion<3>;
template double max_displacement(const Pose<2>&, const Pose<2>&, double);
template double max_displacement(const Pose<3>&, const Pose<3>&, double);

}  // namespace talus
