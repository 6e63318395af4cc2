#pragma once
// What a monitor remembers of a run besides the newest messages. All of it is bounded, whatever is sent.

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/policy/sleep_event.h"

namespace talus {

/// Awake and sleeping bodies at some time.
struct CountSample {
  double time = 0.0;  // simulated [s]
  std::int64_t awake = 0;
  std::int64_t asleep = 0;
};

/// Awake and sleeping bodies over a whole run. When it is full, every second sample goes and later ones come half as
/// often.
class CountHistory {
 public:
  static constexpr std::size_t most_samples = 513;  // odd, so that the last one stays

  /// Takes the next sample; one that is not later than the last is left out.
  void add(const CountSample& sample);

  /// By time, the last one of all included.
  std::span<const CountSample> samples() const { return samples_; }

 private:
  std::vector<CountSample> samples_;
  int stride_ = 1;   // samples that one kept sample stands for
  int skipped_ = 0;  // of these, since the last kept one
};

/// Many bodies that woke in one step for one cause.
struct Wave {
  std::int64_t step = 0;
  std::int64_t bodies = 0;  // 0: there was none
  SleepCause cause = SleepCause::user;
};

/// The latest sleep events of each cause, so that a flood of one cause does not push out the others.
class SleepHistory {
 public:
  static constexpr std::size_t most_events = 200;  // kept for each kind
  static constexpr std::size_t causes = last_cause + 1U;

  /// What happened to a body, and why.
  struct Kind {
    SleepCause cause = SleepCause::user;
    bool woke = false;
    bool operator==(const Kind&) const = default;
  };

  void add(const SleepEvent& event);

  /// Events of a kind so far.
  std::int64_t count(Kind kind) const { return counts_[index(kind)]; }
  /// The newest events of those that `accept` takes, newest first, at most `most`.
  template <class Accept>
  std::vector<SleepEvent> newest(std::size_t most, const Accept& accept) const {
    std::vector<const Numbered*> found;
    for (const auto& events : events_)
      for (const Numbered& each : events)
        if (accept(each.event)) found.push_back(&each);
    return sorted(found, most);
  }
  /// The latest step in which many bodies woke.
  const Wave& wave() const { return wave_; }
  /// How many are many.
  void set_wave_size(std::int64_t bodies) { wave_size_ = bodies; }

 private:
  struct Numbered {
    std::int64_t number = 0;
    SleepEvent event;
  };
  static std::size_t index(Kind kind) { return 2 * static_cast<std::size_t>(kind.cause) + (kind.woke ? 1 : 0); }
  static std::vector<SleepEvent> sorted(std::vector<const Numbered*>& found, std::size_t most);

  std::array<std::deque<Numbered>, 2 * causes> events_;
  std::array<std::int64_t, 2 * causes> counts_{};
  std::int64_t next_ = 0;
  Wave rising_;  // of the present step
  Wave wave_;
  std::int64_t wave_size_ = 20;
};

/// Messages and bytes a second, over the last two seconds.
class RateMeter {
 public:
  using Clock = std::chrono::steady_clock;

  struct Rate {
    double messages = 0.0;  // [1/s]
    double bytes = 0.0;     // [1/s]
  };

  /// A message of so many bytes arrived.
  void add(std::size_t bytes, Clock::time_point now);
  Rate rate(Clock::time_point now) const;

 private:
  static constexpr auto slot_time = std::chrono::milliseconds(250);
  static constexpr std::size_t slots = 8;

  struct Slot {
    std::int64_t number = -1;
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
  };
  std::array<Slot, slots> slots_;
};

}  // namespace talus
