#include "common/measure/trajectory.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "common/math/pose_values.h"
#include "common/math/require.h"

namespace talus {

template <int Dim>
Trajectory<Dim>::Trajectory(double step_time, std::int64_t steps_per_frame, const Periodic<Dim>& periodic)
    : step_time_(step_time), steps_per_frame_(steps_per_frame), periodic_(periodic) {
  require(step_time > 0.0 && std::isfinite(step_time), "step_time", step_time, "must be finite and > 0");
  require(steps_per_frame >= 1, "steps_per_frame", static_cast<double>(steps_per_frame), "must be >= 1");
}

template <int Dim>
void Trajectory<Dim>::begin_frame(std::int64_t step_number, bool lost) {
  if (frames() == 0) first_step_ = step_number;
  if (step_number != step(frames())) {
    throw std::invalid_argument(
        fmt::format("step = {}: the frame after step {} is step {}", step_number, step(frames() - 1), step(frames())));
  }
  first_.push_back(flags_.size());
  lost_.push_back(lost ? 1 : 0);
}

template <int Dim>
void Trajectory<Dim>::append_lost(std::int64_t step_number) {
  begin_frame(step_number, true);
}

template <int Dim>
void Trajectory<Dim>::append(const BodyStates<Dim>& states, std::int64_t step_number,
                             std::span<const std::uint8_t> unknown) {
  if (states.size() < bodies())
    throw std::invalid_argument(fmt::format("states hold {} bodies: {} were there before", states.size(), bodies()));
  begin_frame(step_number, false);
  shape_.assign(states.shape.begin(), states.shape.end());
  for (std::size_t i = 0; i < states.shape.size(); ++i) {
    const Pose<Dim>& pose = states.pose[i];
    append_pose(pose, poses_);
    const bool is_unknown = !unknown.empty() && unknown[i] != 0;
    const int here = states.removed[i] || is_unknown ? 0 : present_flag;
    const int sleeps = states.asleep[i] ? asleep_flag : 0;
    flags_.push_back(static_cast<std::uint8_t>(here | sleeps | (is_unknown ? unknown_flag : 0)));
  }
}

template <int Dim>
BodyIndex Trajectory<Dim>::bodies(int frame) const {
  const std::size_t end = frame + 1 < std::ssize(first_) ? first_[frame + 1] : flags_.size();
  return static_cast<BodyIndex>(end - first_[frame]);
}

template <int Dim>
Vec<Dim> Trajectory<Dim>::position(int frame, BodyIndex body) const {
  const float* values = &poses_[entry(frame, body) * pose_values<Dim>];
  Vec<Dim> position;
  for (int axis = 0; axis < Dim; ++axis) position[axis] = values[axis];
  return position;
}

template <int Dim>
Rotation<Dim> Trajectory<Dim>::rotation(int frame, BodyIndex body) const {
  const float* values = &poses_[entry(frame, body) * pose_values<Dim> + Dim];
  if constexpr (Dim == 2)
    return Rotation<2>(values[0]);
  else
    return Rotation<3>(values[0], values[1], values[2], values[3]).normalized();
}

template <int Dim>
bool Trajectory<Dim>::same(int frame, const Trajectory& other, BodyIndex body) const {
  if (unknown(frame, body) || other.unknown(frame, body)) return true;
  if (!present(frame, body) || !other.present(frame, body)) return present(frame, body) == other.present(frame, body);
  return std::memcmp(&poses_[entry(frame, body) * pose_values<Dim>],
                     &other.poses_[other.entry(frame, body) * pose_values<Dim>], pose_values<Dim> * sizeof(float)) == 0;
}

template class Trajectory<2>;
template class Trajectory<3>;

}  // namespace talus
