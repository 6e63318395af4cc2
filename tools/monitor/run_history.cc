#include "tools/monitor/run_history.h"

#include <algorithm>

namespace talus {

void CountHistory::add(const CountSample& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) return;
  if (skipped_ > 0) samples_.pop_back();  // it only stood for the end
  samples_.push_back(sample);
  skipped_ = (skipped_ + 1) % stride_;
  if (samples_.size() < most_samples || skipped_ != 0) return;
  for (std::size_t i = 0; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
  samples_.resize((samples_.size() + 1) / 2);
  stride_ *= 2;
}

void SleepHistory::add(const SleepEvent& event) {
  const Kind kind{event.cause, event.woke};
  if (index(kind) >= events_.size()) return;
  ++counts_[index(kind)];
  auto& events = events_[index(kind)];
  if (events.size() == most_events) events.pop_front();
  events.push_back({next_++, event});
  if (!event.woke) return;
  if (event.step != rising_.step) rising_ = {.step = event.step};
  rising_.cause = event.cause;
  if (++rising_.bodies >= wave_size_) wave_ = rising_;
}

std::vector<SleepEvent> SleepHistory::sorted(std::vector<const Numbered*>& found, std::size_t most) {
  std::ranges::sort(found, std::ranges::greater(), &Numbered::number);
  if (found.size() > most) found.resize(most);
  std::vector<SleepEvent> events;
  events.reserve(found.size());
  for (const Numbered* each : found) events.push_back(each->event);
  return events;
}

void RateMeter::add(std::size_t bytes, Clock::time_point now) {
  const std::int64_t number = now.time_since_epoch() / slot_time;
  Slot& slot = slots_[static_cast<std::size_t>(number) % slots];
  if (slot.number != number) slot = {.number = number};
  ++slot.messages;
  slot.bytes += static_cast<std::int64_t>(bytes);
}

RateMeter::Rate RateMeter::rate(Clock::time_point now) const {
  const std::int64_t number = now.time_since_epoch() / slot_time;
  constexpr double window = std::chrono::duration<double>(slots * slot_time).count();
  Rate rate;
  for (const Slot& slot : slots_) {
    if (number - slot.number >= static_cast<std::int64_t>(slots)) continue;
    rate.messages += static_cast<double>(slot.messages) / window;
    rate.bytes += static_cast<double>(slot.bytes) / window;
  }
  return rate;
}

}  // namespace talus
