#include "lcmtypes/bodies_message.h"

#include <algorithm>
#include <utility>

#include "common/math/pose_values.h"
#include "lcmtypes/sequence_tracker.h"

namespace talus {

using talus_lcm::talus_bodies;

template <int Dim>
std::vector<talus_bodies> to_bodies(const BodyStates<Dim>& states, std::span<const BodyIndex> bodies, bool key_frame) {
  constexpr std::span fields = layout<talus_bodies>;
  constexpr std::size_t at_most = room<talus_bodies> / (bytes_per_entry(fields, "body_count") +
                                                        pose_values<Dim> * bytes_per_entry(fields, "value_count"));
  std::vector<talus_bodies> messages;
  do {
    const auto here = bodies.first(std::min(bodies.size(), at_most));
    bodies = bodies.subspan(here.size());
    talus_bodies& message = messages.emplace_back();
    message.key_frame = key_frame ? 1 : 0;
    message.dimension = Dim;
    message.body_count = static_cast<std::int32_t>(here.size());
    message.body.assign(here.begin(), here.end());
    for (const BodyIndex body : here) {
      message.shape.push_back(static_cast<std::int16_t>(states.shape[body]));
      message.asleep.push_back(static_cast<std::int8_t>(states.asleep[body]));
      append_pose<Dim>(states.pose[body], message.poses);
    }
    message.value_count = static_cast<std::int32_t>(message.poses.size());
  } while (!bodies.empty());
  return numbered(std::move(messages));
}
template std::vector<talus_bodies> to_bodies<2>(const BodyStates<2>&, std::span<const BodyIndex>, bool);
template std::vector<talus_bodies> to_bodies<3>(const BodyStates<3>&, std::span<const BodyIndex>, bool);

namespace {

void grow(std::size_t count, MomentBodies& bodies) {
  if (count <= bodies.shape.size()) return;
  bodies.shape.resize(count, 0);
  bodies.pose.resize(count);
  bodies.asleep.resize(count, 0);
  bodies.removed.resize(count, 1);
  bodies.unknown.resize(count, 0);
  bodies.cause.resize(count, -1);
}

}  // namespace

bool BodiesReader::take(const talus_bodies& message, MomentBodies& bodies) {
  if (message.step < step_ || !parts_.take(message)) return false;
  const auto is_of_frame = [&](const talus_bodies& part) { return part.key_frame == message.key_frame; };
  if (!std::ranges::all_of(parts_.all(), is_of_frame)) return false;
  apply(bodies);
  return true;
}

void BodiesReader::apply(MomentBodies& bodies) {
  const talus_bodies& first = parts_.all().front();
  if (first.seq != next_number_) doubt(bodies);
  next_number_ = sum_of_counts(parts_.all().back().seq, 1);
  step_ = first.step;
  seen_.assign(bodies.shape.size(), 0);
  for (const talus_bodies& part : parts_.all())
    for (std::size_t entry = 0; entry < part.body.size(); ++entry) set(part, entry, bodies);
  if (first.key_frame != 0) {
    for (std::size_t i = 0; i < seen_.size(); ++i) bodies.removed[i] = seen_[i] != 0 ? 0 : 1;
    bodies.unknown.assign(bodies.shape.size(), 0);
  }
  events_.clear();
  events_lost_ = false;
}

/// Frames are missing: the poses of the bodies that were awake, or fell asleep or woke since, are unknown, and of all
/// where not all events are known.
void BodiesReader::doubt(MomentBodies& bodies) {
  for (std::size_t i = 0; i < bodies.unknown.size(); ++i)
    if (events_lost_ || (bodies.asleep[i] == 0 && bodies.removed[i] == 0)) bodies.unknown[i] = 1;
  for (const BodyIndex body : events_) {
    grow(body + 1, bodies);
    bodies.unknown[body] = 1;
  }
}

void BodiesReader::set(const talus_bodies& message, std::size_t entry, MomentBodies& bodies) {
  const BodyIndex body = message.body[entry];
  grow(body + 1, bodies);
  if (seen_.size() < bodies.shape.size()) seen_.resize(bodies.shape.size(), 0);
  const std::size_t values = message.poses.size() / message.body.size();
  bodies.shape[body] = message.shape[entry];
  bodies.pose.set(body, std::span(message.poses).subspan(values * entry, values));
  const std::uint8_t asleep = message.asleep[entry] != 0 ? 1 : 0;
  if (std::exchange(bodies.asleep[body], asleep) != asleep) bodies.cause[body] = -1;  // until its event is told
  bodies.removed[body] = 0;
  bodies.unknown[body] = 0;
  seen_[body] = 1;
}

std::string_view range_fault(const talus_bodies& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.value_count != m.body_count * (m.dimension == 2 ? 3 : 7)) return "values do not match bodies";
  if (!ascend(m.body)) return "bodies not ascending";
  if (m.body_count > 0 && m.body.front() < 0) return "negative body";
  if (std::any_of(m.shape.begin(), m.shape.end(), is_negative)) return "negative shape";
  return {};
}

}  // namespace talus
