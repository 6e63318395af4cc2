#include "common/measure/gate_counter.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Beyond the gate a body has passed [D].
constexpr double clearance = 0.05;
/// Looks for bodies before the gate in the time after which it is jammed.
constexpr double looks = 10.0;

template <int Dim>
Vec<Dim> centre_of(const GateParams<Dim>& gate) {
  if (gate.corners.empty()) return gate.centre;
  return 0.5 * (gate.corners[1] + gate.corners[Dim == 2 ? 0 : 2]);  // of a parallelogram the corners beside the first
}

template <int Dim>
double reach_of(const GateParams<Dim>& gate, const Vec<Dim>& centre) {
  double reach = gate.corners.empty() ? gate.radius : 0.0;
  for (const Vec<Dim>& corner : gate.corners) reach = std::max(reach, (corner - centre).norm());
  return reach;
}

}  // namespace

template <int Dim>
GateCounter<Dim>::GateCounter(const GateParams<Dim>& params, double extent)
    : params_(params),
      centre_(centre_of(params)),
      forward_axis_(params.forward().normalized()),
      reach_(reach_of(params, centre_)),
      extent_(extent) {}

template <int Dim>
void GateCounter<Dim>::update(const World<Dim>& world, double time, double dt) {
  const BodyStates<Dim>& states = world.states();
  for (auto body = static_cast<BodyIndex>(last_place_.size()); body < states.size(); ++body)
    last_place_.push_back(states.pose[body].position - dt * states.velocity[body]);
  for (const BodyIndex body : world.awake()) {
    const Vec<Dim> at = world.pose_near(body, centre_).position;
    last_place_[body] = world.periodic().near(last_place_[body], at);
    follow(body, at, time, dt);
  }
  if (first_ && world.gravity_size() > 0.0) watch_for_jam(world, time);
}

template <int Dim>
void GateCounter<Dim>::follow(BodyIndex body, const Vec<Dim>& at, double time, double dt) {
  const Vec<Dim> from = last_place_[body];
  last_place_[body] = at;
  const double before = forward_axis_.dot(from - centre_);
  const double after = forward_axis_.dot(at - centre_);
  if ((before < 0.0) != (after < 0.0)) {
    const double share = before / (before - after);
    if (covers(from + share * (at - from))) {
      Crossing& crossing = crossing_[body];
      crossing.net += after < 0.0 ? -1 : 1;
      crossing.time = time - (1.0 - share) * dt;
    }
  }
  if (crossing_.empty() || std::abs(after) < clearance * extent_) return;
  const auto found = crossing_.find(body);
  if (found == crossing_.end()) return;
  count(found->second);
  crossing_.erase(found);
}

template <int Dim>
void GateCounter<Dim>::count(const Crossing& crossing) {
  if (crossing.net == 0) return;
  (crossing.net > 0 ? forward_ : backward_) += std::abs(crossing.net);
  first_ = std::min(first_.value_or(crossing.time), crossing.time);
  last_ = std::max(last_.value_or(crossing.time), crossing.time);
  waiting_since_ = *last_;
  if (jammed()) jams_.back().to = crossing.time;
}

/// Whether a point of the gate's plane, or the projection of any other, lies within the gate.
template <int Dim>
bool GateCounter<Dim>::covers(const Vec<Dim>& point) const {
  const Vec<Dim> away = point - centre_;
  if (params_.corners.empty()) return along_plane<Vec<Dim>>(away, forward_axis_).norm() <= params_.radius;
  const std::vector<Vec<Dim>>& corners = params_.corners;
  const Vec<Dim> from_corner = point - corners[0];
  const auto within = [](double share) { return share >= 0.0 && share <= 1.0; };
  const Vec<Dim> u = corners[1] - corners[0];
  if constexpr (Dim == 2) {
    return within(from_corner.dot(u) / u.squaredNorm());
  } else {
    const Vec<3> v = corners[2] - corners[0];
    const Vec<3> across = u.cross(v);
    return within(from_corner.cross(v).dot(across) / across.squaredNorm()) &&
           within(u.cross(from_corner).dot(across) / across.squaredNorm());
  }
}

template <int Dim>
void GateCounter<Dim>::watch_for_jam(const World<Dim>& world, double time) {
  const double limit = params_.jam_after * time_unit(extent_, world);
  if (time < next_look_) return;
  next_look_ = time + limit / looks;
  if (!any_before(world)) {
    waiting_since_ = time;
    if (jammed()) jams_.back().to = time;
  } else if (!jammed() && (time - waiting_since_ > limit || world.awake().empty())) {
    jams_.push_back({.from = waiting_since_});
  }
}

/// Whether a body is where most have come from, over the opening and no farther than the opening is wide and two D.
template <int Dim>
bool GateCounter<Dim>::any_before(const World<Dim>& world) const {
  const double depth = 2.0 * reach_ + 2.0 * extent_;
  const Vec<Dim> around = Vec<Dim>::Constant(reach_ + depth);
  std::vector<BodyIndex> near;
  world.query_box({centre_ - around, centre_ + around}, near);
  const double upstream = net() >= 0 ? -1.0 : 1.0;
  return std::ranges::any_of(near, [&](BodyIndex body) {
    const Vec<Dim> at = world.pose_near(body, centre_).position;
    const double before = upstream * forward_axis_.dot(at - centre_);
    return before > 0.0 && before <= depth && covers(at - upstream * before * forward_axis_);
  });
}

template <int Dim>
std::optional<double> GateCounter<Dim>::rate() const {
  if (std::abs(net()) < 2 || *last_ <= *first_) return std::nullopt;
  const auto counted = static_cast<double>(net() > 0 ? net() - 1 : net() + 1);
  return counted / (*last_ - *first_);
}

template class GateCounter<2>;
template class GateCounter<3>;

}  // namespace talus
