#include "tools/monitor/run_view.h"

#include <algorithm>

#include "lcmtypes/sleep_message.h"

namespace talus {

using talus_lcm::talus_pile;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

namespace {

// Forged messages can name any number of piles and layers: beyond these a pile is not kept.
constexpr std::size_t max_piles = 1000;
constexpr std::size_t max_layers_kept = 64 * max_layers;
constexpr std::int64_t fewest_in_wave = 20;  // bodies that wake in one step, else a tenth of all

}  // namespace

template <class Message>
bool RunView::note(const Message& message) {
  const bool newest = trackers_[static_cast<std::size_t>(channel_of<Message>)].see(message.seq);
  if (newest && message.step >= step_) {
    step_ = message.step;
    sim_time_ = message.sim_time;
  }
  return newest;
}

void RunView::take(const talus_run& message) {
  if (!note(message)) return;
  run_ = message;
  for (const Channel channel : all_channels) {
    const auto named = std::find(message.channels.begin(), message.channels.end(), name_of(channel));
    if (channel == Channel::run || named == message.channels.end()) continue;
    trackers_[static_cast<std::size_t>(channel)].expect(message.sent[named - message.channels.begin()]);
  }
}

void RunView::take(const talus_piles& message) {
  note(message);
  if (message.step < piles_step_) return;
  piles_step_ = message.step;
  for (std::int32_t i = 0; i < message.pile_count; ++i) {
    const talus_pile& pile = message.piles[i];
    const std::int32_t number = message.first_pile + i;
    if (pile.merged_into >= 0)
      forget(number);
    else
      keep(number, pile);
  }
}

void RunView::forget(std::int32_t number) {
  const auto known = piles_.find(number);
  if (known == piles_.end()) return;
  layers_kept_ -= known->second.layers.size();
  piles_.erase(known);
}

void RunView::keep(std::int32_t number, const talus_pile& pile) {
  forget(number);
  if (piles_.size() >= max_piles || layers_kept_ + pile.layers.size() > max_layers_kept) {
    ++piles_left_out_;
    return;
  }
  layers_kept_ += pile.layers.size();
  piles_.emplace(number, pile);
}

void RunView::take(const talus_sleep& message) {
  const std::int64_t before = received(Channel::sleep);
  note(message);
  if (received(Channel::sleep) == before) return;  // a duplicate
  const auto woken = std::count(message.woke.begin(), message.woke.end(), 1);
  woken_ += woken;
  slept_ += message.event_count - woken;
  for (const SleepEvent& event : events_of(message)) sleep_.add(event);
}

void RunView::take(const talus_stats& message) {
  if (!note(message)) return;
  stats_ = message;
  counts_.add({.time = message.sim_time, .awake = message.awake, .asleep = message.asleep});
  sleep_.set_wave_size(std::max<std::int64_t>(fewest_in_wave, (std::int64_t{message.awake} + message.asleep) / 10));
}

void RunView::take(const talus_lcm::talus_bodies& message) { note(message); }

void RunView::take(const talus_lcm::talus_shapes& message) { note(message); }

void RunView::take(const talus_lcm::talus_event& message) { note(message); }

void RunView::take(const talus_lcm::talus_obstacles& message) { note(message); }

void RunView::take(const talus_lcm::talus_scene& message) { note(message); }

bool RunView::is_restart(const talus_run& message) const {
  return run_ && message.seq < run_->seq && (message.phase == talus_run::BEGIN || ended());
}

std::int64_t RunView::lost() const {
  std::int64_t sum = 0;
  for (const SequenceTracker& tracker : trackers_) sum = sum_of_counts(sum, tracker.lost());
  return sum;
}

std::int64_t RunView::received() const {
  std::int64_t sum = 0;
  for (const SequenceTracker& tracker : trackers_) sum += tracker.received();
  return sum;
}

}  // namespace talus
