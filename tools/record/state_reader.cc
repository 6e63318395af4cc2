#include "tools/record/state_reader.h"

#include <fmt/format.h>

#include <stdexcept>

namespace talus {

namespace {

template <int Dim>
Pose<Dim> pose_of(const float* values) {
  if constexpr (Dim == 2) {
    return {{values[0], values[1]}, Rotation<2>(values[2])};
  } else {
    return {{values[0], values[1], values[2]}, Rotation<3>(values[3], values[4], values[5], values[6])};
  }
}

/// Turn from one rotation to another as a vector [rad].
template <int Dim>
Spin<Dim> turn(const Rotation<Dim>& from, const Rotation<Dim>& to) {
  if constexpr (Dim == 2) {
    return Spin<2>((to * from.inverse()).smallestAngle());
  } else {
    const Eigen::AngleAxisd step(to * from.inverse());
    return step.angle() * step.axis();
  }
}

}  // namespace

template <int Dim>
bool StateReader<Dim>::take(const talus_lcm::talus_bodies_v1& message) {
  if (message.dimension != Dim)
    throw std::invalid_argument(fmt::format("poses in {}D: must be {}D", message.dimension, Dim));
  if (message.part == 0) begin(message);
  for (std::size_t entry = 0; entry < message.body.size(); ++entry) set(message, entry);
  if (message.part + 1 < message.parts) return false;
  if (message.key_frame) {
    for (std::size_t i = 0; i < seen_.size(); ++i) states_.removed[i] = seen_[i] != 0 ? 0 : 1;
  }
  return true;
}

template <int Dim>
void StateReader<Dim>::begin(const talus_lcm::talus_bodies_v1& message) {
  if (message.step > step_) {
    before_ = states_;
    step_before_ = step_;
  }
  step_ = message.step;
  seen_.assign(states_.shape.size(), 0);
}

template <int Dim>
void StateReader<Dim>::set(const talus_lcm::talus_bodies_v1& message, std::size_t entry) {
  constexpr std::size_t values = Dim == 2 ? 3 : 7;
  if (message.body[entry] >= bodies_ || message.shape[entry] >= shapes_) {
    throw std::invalid_argument(fmt::format("step {}: body {} of shape {}, but the scene has {} bodies and {} shapes",
                                            message.step, message.body[entry], message.shape[entry], bodies_, shapes_));
  }
  const auto body = static_cast<std::size_t>(message.body[entry]);
  if (body >= states_.shape.size()) {
    states_.shape.resize(body + 1, 0);
    states_.pose.resize(body + 1);
    states_.velocity.resize(body + 1, Vec<Dim>::Zero());
    states_.spin.resize(body + 1, Spin<Dim>::Zero());
    states_.asleep.resize(body + 1, 0);
    states_.removed.resize(body + 1, 1);
    seen_.resize(body + 1, 0);
  }
  states_.shape[body] = message.shape[entry];
  states_.pose[body] = pose_of<Dim>(message.poses.data() + values * entry);
  states_.asleep[body] = message.asleep[entry] != 0 ? 1 : 0;
  states_.removed[body] = 0;
  seen_[body] = 1;
}

template <int Dim>
BodyStates<Dim> StateReader<Dim>::states_with_velocities(double dt) const {
  BodyStates<Dim> states = states_;
  const double time = dt * static_cast<double>(step_ - step_before_);
  for (std::size_t i = 0; i < before_.shape.size(); ++i) {
    if (states.asleep[i] != 0 || states.removed[i] != 0 || before_.removed[i] != 0) continue;
    states.velocity[i] = (states.pose[i].position - before_.pose[i].position) / time;
    states.spin[i] = turn<Dim>(before_.pose[i].rotation, states.pose[i].rotation) / time;
  }
  return states;
}

template class StateReader<2>;
template class StateReader<3>;

}  // namespace talus
