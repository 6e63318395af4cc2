#pragma once

#include <cstdint>
#include <limits>

namespace talus {

/// Sum of two counts >= 0, at most the largest number: forged messages can claim any loss.
inline std::int64_t sum_of_counts(std::int64_t a, std::int64_t b) {
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  return a > largest - b ? largest : a + b;
}

/// Counts the messages that are missing on one channel, from their numbers. Distinguishes duplicates from late ones
/// within the last 64 numbers; what comes later than that counts as lost.
class SequenceTracker {
 public:
  /// A message with this number, >= 0, came. Whether it is the newest so far: not late, and no duplicate.
  bool see(std::int64_t number);

  /// The sender says that all numbers below `next` were sent.
  void expect(std::int64_t next);

  /// Missing since the first number that was seen or expected.
  std::int64_t lost() const { return next_ - first_ - received_; }
  std::int64_t received() const { return received_; }

 private:
  void advance_to(std::int64_t next);

  bool started_ = false;
  std::int64_t first_ = 0;
  std::int64_t next_ = 0;      // above the newest
  std::int64_t received_ = 0;  // each number once
  std::uint64_t seen_ = 0;     // bit i: number next_ - 1 - i was seen
};

}  // namespace talus
