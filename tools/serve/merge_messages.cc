#include "tools/serve/merge_messages.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <sstream>
#include <vector>

#include "lcmtypes/event_log.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/message.h"
#include "lcmtypes/wire.h"

namespace talus {
namespace {

using talus_lcm::talus_bodies;

/// The pose of one body, as a message has it.
struct BodyEntry {
  std::int32_t body = 0;
  std::int16_t shape = 0;
  std::int8_t asleep = 0;
  std::span<const float> pose;
};

/// The messages of one moment. The last parts of poses are those of its whole frame; others before are what is left of
/// frames that were lost.
struct MomentEvents {
  std::vector<LogEvent> others;
  std::vector<talus_bodies> bodies;

  bool has(std::string_view channel) const { return std::ranges::count(others, channel, &LogEvent::channel) > 0; }
  bool key_frame() const { return !bodies.empty() && bodies.front().key_frame != 0; }
};

MomentEvents events_of(std::string_view log) {
  MomentEvents moment;
  LogReader reader(std::make_unique<std::istringstream>(std::string(log)));
  for (LogEvent event; reader.next(event);) {
    talus_bodies message;
    if (event.channel != name_of(Channel::bodies)) {
      moment.others.push_back(event);
    } else if (decode(event.data, message).empty()) {
      if (message.part == 0) moment.bodies.clear();
      moment.bodies.push_back(std::move(message));
    }
  }
  return moment;
}

std::vector<BodyEntry> entries_of(std::span<const talus_bodies> parts) {
  std::vector<BodyEntry> entries;
  for (const talus_bodies& part : parts) {
    const std::size_t width = part.body.empty() ? 0 : part.poses.size() / part.body.size();
    for (std::size_t i = 0; i < part.body.size(); ++i)
      entries.push_back({part.body[i], part.shape[i], part.asleep[i], std::span(part.poses).subspan(i * width, width)});
  }
  return entries;
}

/// Newer ones replace older ones; both ascend.
std::vector<BodyEntry> merged(std::span<const BodyEntry> older, std::span<const BodyEntry> newer) {
  std::vector<BodyEntry> all;
  std::ranges::set_union(newer, older, std::back_inserter(all), {}, &BodyEntry::body, &BodyEntry::body);
  return all;
}

/// Numbers the messages so that the last one has the number of `header`. A reader ignores numbers that it has received.
void append_bodies(std::span<const BodyEntry> entries, const talus_bodies& header, bool key_frame, std::string& log) {
  constexpr std::size_t most = 1500;  // in one message: in 3D of 35 bytes each
  MessageEncoder encoder(header.run_id);
  const std::size_t parts = std::max<std::size_t>(1, (entries.size() + most - 1) / most);
  for (std::size_t part = 0; part < parts; ++part, entries = entries.subspan(std::min(most, entries.size()))) {
    talus_bodies message;
    message.key_frame = key_frame ? 1 : 0;
    message.part = static_cast<std::int32_t>(part);
    message.parts = static_cast<std::int32_t>(parts);
    message.dimension = header.dimension;
    for (const BodyEntry& entry : entries.first(std::min(most, entries.size()))) {
      message.body.push_back(entry.body);
      message.shape.push_back(entry.shape);
      message.asleep.push_back(entry.asleep);
      message.poses.insert(message.poses.end(), entry.pose.begin(), entry.pose.end());
    }
    message.body_count = static_cast<std::int32_t>(message.body.size());
    message.value_count = static_cast<std::int32_t>(message.poses.size());
    Packet packet = encoder.encode(message, {.utime = header.utime, .step = header.step, .sim_time = header.sim_time});
    renumber(packet.bytes, std::max<std::int64_t>(0, header.seq - static_cast<std::int64_t>(parts - 1 - part)));
    append_event(log, 0, packet.utime, packet.channel, packet.bytes);
  }
}

void append(const LogEvent& event, std::string& log) {
  append_event(log, event.number, event.timestamp, *channel_named(event.channel), event.data);
}

}  // namespace

std::string merge_messages(std::string_view first, std::string_view second) {
  const MomentEvents a = events_of(first);
  const MomentEvents b = events_of(second);
  std::string log;
  for (const LogEvent& event : a.others) {
    const Channel channel = *channel_named(event.channel);
    const bool is_state = channel == Channel::piles || channel == Channel::stats || channel == Channel::obstacles ||
                          channel == Channel::instruments || channel == Channel::contacts;
    if (!is_state || !b.has(event.channel)) append(event, log);
  }
  for (const LogEvent& event : b.others) append(event, log);
  if (a.bodies.empty() && b.bodies.empty()) return log;
  const talus_bodies& header = b.bodies.empty() ? a.bodies.back() : b.bodies.back();
  const std::vector<BodyEntry> newer = entries_of(b.bodies);
  append_bodies(b.key_frame() ? newer : merged(entries_of(a.bodies), newer), header, a.key_frame() || b.key_frame(),
                log);
  return log;
}

}  // namespace talus
