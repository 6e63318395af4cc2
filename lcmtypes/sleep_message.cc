#include "lcmtypes/sleep_message.h"

#include <algorithm>

#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_sleep;

std::vector<talus_sleep> to_sleep(std::span<const SleepEvent> events) {
  constexpr std::size_t at_most = room<talus_sleep> / bytes_per_entry(layout<talus_sleep>, "event_count");
  std::vector<talus_sleep> messages;
  for (; !events.empty(); events = events.subspan(messages.back().event_count)) {
    talus_sleep& message = messages.emplace_back();
    for (const SleepEvent& event : events.first(std::min(events.size(), at_most))) {
      message.body.push_back(event.body);
      message.pile.push_back(event.pile);
      message.layer.push_back(event.layer);
      message.woke.push_back(event.woke ? 1 : 0);
      message.cause.push_back(static_cast<std::int8_t>(event.cause));
      message.score.push_back(static_cast<float>(event.score));
    }
    message.event_count = static_cast<std::int32_t>(message.body.size());
  }
  return numbered(std::move(messages));
}

std::vector<SleepEvent> events_of(const talus_sleep& message) {
  std::vector<SleepEvent> events;
  events.reserve(message.body.size());
  for (std::size_t i = 0; i < message.body.size(); ++i) {
    events.push_back({.step = message.step,
                      .body = message.body[i],
                      .pile = message.pile[i],
                      .layer = message.layer[i],
                      .woke = message.woke[i] != 0,
                      .cause = static_cast<SleepCause>(message.cause[i]),
                      .score = message.score[i]});
  }
  return events;
}

std::string_view range_fault(const talus_sleep& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (std::any_of(m.body.begin(), m.body.end(), is_negative)) return "negative body";
  if (!std::all_of(m.pile.begin(), m.pile.end(), is_index_or_none)) return "pile out of range";
  if (!std::all_of(m.layer.begin(), m.layer.end(), is_index_or_none)) return "layer out of range";
  const auto known = [](std::int8_t cause) { return cause >= talus_sleep::SCORE && cause <= talus_sleep::MOTION; };
  if (!std::all_of(m.cause.begin(), m.cause.end(), known)) return "unknown cause";
  return {};
}

}  // namespace talus
