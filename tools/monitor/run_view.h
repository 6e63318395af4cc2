#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

#include "lcmtypes/channels.h"
#include "tools/monitor/run_history.h"
#include "tools/monitor/sequence_tracker.h"

namespace talus {

/// What is known of one run: the newest message of each kind, and what was lost. Older messages than those known are
/// counted but change nothing. Of poses, shapes and events of the scene it keeps only the count.
class RunView {
 public:
  void take(const talus_lcm::talus_run_v1& message);
  void take(const talus_lcm::talus_piles_v2& message);
  void take(const talus_lcm::talus_sleep_v1& message);
  void take(const talus_lcm::talus_stats_v2& message);
  void take(const talus_lcm::talus_bodies_v1& message);
  void take(const talus_lcm::talus_shapes_v1& message);
  void take(const talus_lcm::talus_event_v2& message);
  void take(const talus_lcm::talus_obstacles_v1& message);
  void take(const talus_lcm::talus_scene_v1& message);

  /// The run's number was used before; nothing of that is left. A record that is played twice does so.
  bool is_restart(const talus_lcm::talus_run_v1& message) const;

  const std::optional<talus_lcm::talus_run_v1>& run() const { return run_; }
  const std::optional<talus_lcm::talus_stats_v2>& stats() const { return stats_; }
  /// By number, as last heard of; without those that became part of another.
  const std::map<std::int32_t, talus_lcm::talus_pile_v2>& piles() const { return piles_; }

  /// Piles received for which there is no room here; each message counts.
  std::int64_t piles_left_out() const { return piles_left_out_; }

  std::int64_t step() const { return step_; }    // the newest of any message
  double sim_time() const { return sim_time_; }  // [s] at that step
  bool ended() const { return run_ && run_->phase == talus_lcm::talus_run_v1::END; }

  std::int64_t lost(Channel channel) const { return trackers_[static_cast<std::size_t>(channel)].lost(); }
  std::int64_t lost() const;
  std::int64_t received(Channel channel) const { return trackers_[static_cast<std::size_t>(channel)].received(); }
  std::int64_t received() const;
  std::int64_t slept() const { return slept_; }  // events, all so far
  std::int64_t woken() const { return woken_; }
  const CountHistory& counts() const { return counts_; }
  const SleepHistory& sleep() const { return sleep_; }

 private:
  /// Counts a message. Whether it is the newest of its channel.
  template <class Message>
  bool note(const Message& message);
  void forget(std::int32_t number);
  void keep(std::int32_t number, const talus_lcm::talus_pile_v2& pile);

  std::array<SequenceTracker, channel_names.size()> trackers_;
  std::optional<talus_lcm::talus_run_v1> run_;
  std::optional<talus_lcm::talus_stats_v2> stats_;
  std::map<std::int32_t, talus_lcm::talus_pile_v2> piles_;
  std::size_t layers_kept_ = 0;  // of all piles_
  std::int64_t piles_left_out_ = 0;
  std::int64_t piles_step_ = -1;
  std::int64_t step_ = 0;
  double sim_time_ = 0.0;
  std::int64_t slept_ = 0;
  std::int64_t woken_ = 0;
  CountHistory counts_;
  SleepHistory sleep_;
};

}  // namespace talus
