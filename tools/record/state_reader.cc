#include "tools/record/state_reader.h"

#include <fmt/format.h>

#include <stdexcept>

#include "tools/monitor/sequence_tracker.h"

namespace talus {
namespace {

template <int Dim>
Pose<Dim> pose_of(const float* values) {
  if constexpr (Dim == 2)
    return {{values[0], values[1]}, Rotation<2>(values[2])};
  else
    return {{values[0], values[1], values[2]}, Rotation<3>(values[3], values[4], values[5], values[6])};
}

}  // namespace

template <int Dim>
bool StateReader<Dim>::take(const Message& message) {
  check(message);
  if (message.part == 0) parts_.clear();
  const bool next_part = message.part == static_cast<std::int32_t>(parts_.size());
  const bool same_frame = parts_.empty() || (message.step == parts_[0].step && message.parts == parts_[0].parts &&
                                             message.key_frame == parts_[0].key_frame);
  if (!next_part || !same_frame || message.step < step_) {
    parts_.clear();
    return false;
  }
  parts_.push_back(message);
  if (message.part + 1 < message.parts) return false;
  apply();
  return true;
}

template <int Dim>
void StateReader<Dim>::check(const Message& message) const {
  if (message.dimension != Dim)
    throw std::invalid_argument(fmt::format("poses in {}D: must be {}D", message.dimension, Dim));
  for (std::size_t entry = 0; entry < message.body.size(); ++entry) {
    if (message.body[entry] < bodies_ && message.shape[entry] < shapes_) continue;
    throw std::invalid_argument(fmt::format("step {}: body {} of shape {}, but the scene has {} bodies and {} shapes",
                                            message.step, message.body[entry], message.shape[entry], bodies_, shapes_));
  }
}

template <int Dim>
void StateReader<Dim>::note_event(BodyIndex body) {
  if (body >= bodies_)
    throw std::invalid_argument(fmt::format("sleep event of body {}, but the scene has {} bodies", body, bodies_));
  events_.push_back(body);
}

template <int Dim>
void StateReader<Dim>::apply() {
  if (parts_[0].seq != next_number_) doubt();
  next_number_ = sum_of_counts(parts_.back().seq, 1);
  step_ = parts_[0].step;
  seen_.assign(states_.shape.size(), 0);
  for (const Message& part : parts_)
    for (std::size_t entry = 0; entry < part.body.size(); ++entry) set(part, entry);
  if (parts_[0].key_frame != 0) {
    for (std::size_t i = 0; i < seen_.size(); ++i) states_.removed[i] = seen_[i] != 0 ? 0 : 1;
    unknown_.assign(states_.shape.size(), 0);
  }
  parts_.clear();
  events_.clear();
  events_lost_ = false;
}

/// Frames are missing: the poses of the bodies that were awake, or fell asleep or woke since, are unknown, and of all
/// where not all events are known.
template <int Dim>
void StateReader<Dim>::doubt() {
  for (std::size_t i = 0; i < unknown_.size(); ++i)
    if (events_lost_ || (states_.asleep[i] == 0 && states_.removed[i] == 0)) unknown_[i] = 1;
  for (const BodyIndex body : events_) {
    grow(body + 1);
    unknown_[body] = 1;
  }
}

template <int Dim>
void StateReader<Dim>::grow(std::size_t bodies) {
  if (bodies <= states_.shape.size()) return;
  states_.shape.resize(bodies, 0);
  states_.pose.resize(bodies);
  states_.velocity.resize(bodies, Vec<Dim>::Zero());
  states_.spin.resize(bodies, Spin<Dim>::Zero());
  states_.asleep.resize(bodies, 0);
  states_.removed.resize(bodies, 1);
  seen_.resize(bodies, 0);
  unknown_.resize(bodies, 0);
}

template <int Dim>
void StateReader<Dim>::set(const Message& message, std::size_t entry) {
  const BodyIndex body = message.body[entry];
  constexpr std::size_t values = Dim == 2 ? 3 : 7;
  grow(body + 1);
  states_.shape[body] = message.shape[entry];
  states_.pose[body] = pose_of<Dim>(message.poses.data() + values * entry);
  states_.asleep[body] = message.asleep[entry] != 0 ? 1 : 0;
  states_.removed[body] = 0;
  seen_[body] = 1;
  unknown_[body] = 0;
}

template class StateReader<2>;
template class StateReader<3>;

}  // namespace talus
