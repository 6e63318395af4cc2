#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "lcmtypes/moment_reader.h"
#include "tools/monitor/run_history.h"

namespace talus {

/// What is known of one run: what its reader has of it, poses left out, and what a monitor remembers besides.
class RunView {
 public:
  /// Takes a message that has passed decode().
  template <class Message>
  void take(const Message& message) {
    const std::int64_t before = reader_.received(channel_of<Message>);
    reader_.take(message);
    if (reader_.received(channel_of<Message>) == before) return;  // a duplicate
    if (message.step >= step_) {
      step_ = message.step;
      sim_time_ = message.sim_time;
    }
    if constexpr (std::is_same_v<Message, talus_lcm::talus_sleep> || std::is_same_v<Message, talus_lcm::talus_stats>)
      remember(message);
  }

  const MomentReader& reader() const { return reader_; }
  const std::optional<talus_lcm::talus_run>& run() const { return reader_.run(); }
  const std::optional<talus_lcm::talus_stats>& stats() const { return reader_.stats(); }
  bool ended() const { return run() && run()->phase == talus_lcm::talus_run::END; }
  std::int64_t lost() const { return reader_.lost(); }
  std::int64_t received() const { return reader_.received(); }

  std::int64_t step() const { return step_; }    // the newest of any message
  double sim_time() const { return sim_time_; }  // [s] at that step

  /// Piles with layers, by their number: without those that became part of another.
  struct NumberedPile {
    int number = 0;
    const Pile<3>* pile = nullptr;
  };
  std::vector<NumberedPile> piles() const;

  const CountHistory& counts() const { return counts_; }
  const SleepHistory& sleep() const { return sleep_; }

 private:
  void remember(const talus_lcm::talus_sleep& message);
  void remember(const talus_lcm::talus_stats& message);

  MomentReader reader_{2, {.later_events = 0, .poses = false}};
  std::int64_t step_ = 0;
  double sim_time_ = 0.0;
  CountHistory counts_;
  SleepHistory sleep_;
};

}  // namespace talus
