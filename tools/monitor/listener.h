#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tools/monitor/receiver_process.h"
#include "tools/monitor/run_table.h"

namespace talus {

/// Checks, decodes and keeps what a network sends of all runs.
class Listener {
 public:
  using Clock = RunTable::Clock;

  /// Takes a message that arrived at `now`.
  void hear(const Datagram& datagram, Clock::time_point now = Clock::now());

  RunTable& runs() { return runs_; }
  const RunTable& runs() const { return runs_; }

  /// Messages on the channels of a run that were of another kind or damaged, and what was wrong with the last one.
  std::int64_t undecodable() const;
  std::int64_t undecodable(Channel channel) const { return undecodable_[static_cast<std::size_t>(channel)]; }
  const std::string& last_fault() const { return last_fault_; }

 private:
  template <class Message>
  void hear(const Datagram& datagram, Message& message, Clock::time_point now);

  RunTable runs_;
  std::array<std::int64_t, channel_names.size()> undecodable_{};
  std::string last_fault_;
};

}  // namespace talus
