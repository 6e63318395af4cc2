#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "common/policy/observer.h"
#include "lcmtypes/moment_writer.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/send_queue.h"

namespace talus {

struct PublisherParams {
  std::string url = {};        // LCM's address; empty: LCM_DEFAULT_URL, else multicast that stays on this machine
  bool allow_network = false;  // let packets leave this machine (ttl above 0); any machine there may then listen
  double piles_rate = 60.0;    // [1/s] of wall time, >= 0; 0: every step, which costs a fast simulation a few per cent
  double bodies_rate = 30.0;   // [1/s] of wall time at which poses are sent, >= 0; 0: never. Less where a frame of the
                               // awake bodies alone has more than bodies_bytes_per_second allow
  std::size_t queue_bytes = 8U << 20U;  // room for what waits to be sent, >= 1 MiB; small: an avalanche of 100,000
                                        // events is dropped in part
};

/// Poses and contacts take at most so many bytes a second of wall time: what a receiver at default settings of the
/// kernel hears without loss.
inline constexpr double bodies_bytes_per_second = 12e6;

/// Comes due `rate` times a second of wall time, or as often as due() is called.
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
    next_ = std::max(next_ + period_, now);  // late by less than a period: made up for
    if (next_ - now < period_ / 2) next_ = now + period_ / 2;
    return true;
  }
  /// Not due before.
  void wait_until(Clock::time_point time) { next_ = std::max(next_, time); }

 private:
  Clock::duration period_;
  Clock::time_point next_{};
};

/// Shows a run live over LCM. Only sends, never waits, and never changes the run. Without a way into the network it
/// warns once and does nothing.
template <int Dim>
class Publisher final : public Observer<Dim>, private MessageSink {
 public:
  /// Throws std::invalid_argument on bad parameters, an address that leaves the machine among them.
  explicit Publisher(const RunInfo& info, const PublisherParams& params = {});
  /// Sends through an `lcm` that lives longer than this object; the parameters' address means nothing.
  Publisher(const RunInfo& info, const PublisherParams& params, lcm::LCM& lcm);

  /// Poses are sent only once the shapes are known. Throws std::invalid_argument on a shape too large for a message.
  void set_world(const WorldDescription<Dim>& world) {
    if (bodies_rate_ > 0.0) writer_.set_world(world);
  }
  /// The scene's events and the poses of its obstacles that move are sent too.
  void set_scene(const Scene<Dim>& scene) { writer_.set_scene(scene); }

  /// After set_scene(), before the first frame: the readings of the scene's instruments are told too. `meters` must be
  /// an observer of the run before this one, and live longer.
  void set_instruments(const InstrumentMeters<Dim>& meters) { writer_.set_instruments(meters); }
  /// The same for the contacts, while they are wanted.
  void set_contacts(const ContactForces<Dim>& contacts) { writer_.set_contacts(contacts); }

  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

  bool connected() const { return queue_ != nullptr; }
  std::int64_t run_id() const { return run_id_; }
  /// Messages given up so far.
  std::int64_t dropped() const { return queue_ ? queue_->dropped() : 0; }

 private:
  using Clock = Pulse::Clock;
  Publisher(const RunInfo& info, const PublisherParams& params, std::unique_ptr<SendQueue> queue);
  std::int64_t stamp(double time) override;
  void put(Packet packet) override { queue_->push(std::move(packet)); }
  void send_stats(const Frame<Dim>& frame, Clock::time_point now);
  void send_bodies(const Frame<Dim>& frame, Clock::time_point now);

  std::int64_t run_id_ = 0;
  std::unique_ptr<SendQueue> queue_;
  MomentWriter<Dim> writer_;
  Pulse run_pulse_{1.0};
  Pulse stats_pulse_{10.0};
  Pulse shapes_pulse_{1.0};
  Pulse events_pulse_{1.0};
  Pulse piles_pulse_;
  Pulse bodies_pulse_;
  Pulse key_frames_pulse_{1.0};  // after bodies have left the world
  double bodies_rate_ = 0.0;
  BodyIndex turn_ = 0;  // the body from which on poses of resting ones are sent next
  // Since the last statistics:
  PhaseTimes sum_;
  std::int64_t summed_steps_ = 0;
  Clock::time_point stats_wall_ = Clock::now();
  double stats_time_ = 0.0;  // simulated [s]
};

}  // namespace talus
