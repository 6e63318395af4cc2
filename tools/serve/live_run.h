#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/monitor/receiver_process.h"
#include "tools/serve/page_hub.h"

namespace talus {

/// Relays the messages of one run to the pages of a hub, moment by moment. Follows the first run that it
/// hears, and another one once that has ended or was silent for two seconds.
class LiveRun {
 public:
  using Clock = std::chrono::steady_clock;
  /// `waiting`: what pages are told before a run is heard.
  LiveRun(PageHub& hub, const std::string& waiting);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// Takes a message that arrived at `now`. What does not decode is left out and counted.
  void hear(const Datagram& datagram, Clock::time_point now = Clock::now());

  std::int64_t undecodable() const { return undecodable_; }

 private:
  class Followed;
  template <class Message>
  void hear(const Datagram& datagram, Message& message, Clock::time_point now);

  void show_status();

  PageHub& hub_;
  std::unique_ptr<Followed> followed_;
  Clock::time_point heard_{};
  std::int64_t undecodable_ = 0;
};

}  // namespace talus
