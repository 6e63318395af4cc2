#include "lcmtypes/bodies_reader.h"

#include <algorithm>
#include <span>

#include "lcmtypes/sequence_tracker.h"

namespace talus {

using talus_lcm::talus_bodies;

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
  bodies.asleep[body] = message.asleep[entry] != 0 ? 1 : 0;
  bodies.removed[body] = 0;
  bodies.unknown[body] = 0;
  seen_[body] = 1;
}

}  // namespace talus
