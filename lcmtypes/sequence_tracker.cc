#include "lcmtypes/sequence_tracker.h"

#include <algorithm>

namespace talus {

bool SequenceTracker::see(std::int64_t number) {
  number = std::min(number, std::numeric_limits<std::int64_t>::max() - 1);  // so that next_ can be above it
  if (!started_) expect(number);
  if (number < next_) {
    const std::int64_t age = next_ - 1 - number;
    if (number < first_ || age >= 64 || (seen_ >> age & 1U) != 0) return false;
    seen_ |= std::uint64_t{1} << age;
    ++received_;
    return false;
  }
  advance_to(number + 1);
  seen_ |= 1U;
  ++received_;
  return true;
}

void SequenceTracker::expect(std::int64_t next) {
  if (!started_) {
    started_ = true;
    first_ = next;
    next_ = next;
  } else if (next > next_) {
    advance_to(next);
  }
}

void SequenceTracker::advance_to(std::int64_t next) {
  const std::int64_t distance = next - next_;
  seen_ = distance < 64 ? seen_ << distance : 0;
  next_ = next;
}

}  // namespace talus
