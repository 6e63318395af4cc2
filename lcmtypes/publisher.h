#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/simulation/observer.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/send_queue.h"

namespace talus {

struct PublisherParams {
  std::string url = {};        // LCM's address; empty: LCM_DEFAULT_URL, else multicast that stays on this machine
  bool allow_network = false;  // let packets leave this machine (ttl above 0); any machine there may then listen
  double piles_rate = 60.0;    // [1/s] of wall time, >= 0; 0: every step, which costs a fast simulation a few per cent
  std::size_t queue_bytes = 8U << 20U;  // room for what waits to be sent, >= 1 MiB; small: an avalanche of 100,000
                                        // events is dropped in part
};

/// Comes due at most `rate` times a second of wall time.
class Pulse {
 public:
  using Clock = std::chrono::steady_clock;
  /// Rate 0: always due. At most a day passes between two.
  explicit Pulse(double rate)
      : period_(rate > 0.0 ? std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(std::min(1.0 / rate, 86400.0)))
                           : Clock::duration::zero()) {}
  bool due(Clock::time_point now) {
    if (now < next_) return false;
    next_ = now + period_;
    return true;
  }

 private:
  Clock::duration period_;
  Clock::time_point next_{};
};

/// Shows a run live over LCM. Only sends, never waits, and never changes the run. Without a way into the network it
/// warns once and does nothing.
template <int Dim>
class Publisher final : public Observer<Dim> {
 public:
  /// Throws std::invalid_argument on bad parameters, an address that leaves the machine among them.
  explicit Publisher(const RunInfo& info, const PublisherParams& params = {});
  /// Sends through an `lcm` that lives longer than this object; the parameters' address means nothing.
  Publisher(const RunInfo& info, const PublisherParams& params, lcm::LCM& lcm);

  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

  bool connected() const { return queue_ != nullptr; }
  std::int64_t run_id() const { return run_id_; }
  /// Messages given up so far.
  std::int64_t dropped() const { return queue_ ? queue_->dropped() : 0; }

 private:
  using Clock = Pulse::Clock;
  void begin();
  template <class Message>
  void send(Message& message, std::int64_t step, double time);
  template <class Message>
  void send(std::vector<Message> messages, std::int64_t step, double time);
  void send_run(std::int8_t phase, std::string_view reason, std::int64_t step, double time);
  void send_stats(const Frame<Dim>& frame, Clock::time_point now);

  RunInfo info_;
  std::int64_t run_id_;
  MessageEncoder encoder_;
  std::unique_ptr<SendQueue> queue_;
  Pulse run_pulse_{1.0};
  Pulse stats_pulse_{10.0};
  Pulse piles_pulse_;
  // Since the last statistics:
  PhaseTimes sum_;
  std::int64_t summed_steps_ = 0;
  Clock::time_point stats_wall_ = Clock::now();
  double stats_time_ = 0.0;  // simulated [s]
};

}  // namespace talus
