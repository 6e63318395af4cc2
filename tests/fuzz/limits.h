#pragma once
// What no input may cost.

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace talus::fuzz {

/// Aborts when its scope takes more than a second of processor time. libFuzzer's own limit is of wall time, which a
/// busy machine exceeds by itself.
class TimeLimit {
 public:
  TimeLimit() = default;
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit() {
    const double seconds = static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
    if (seconds <= limit) return;
    std::fprintf(stderr, "fuzz: the input takes %.2f s of processor time: must be at most %.2f\n", seconds, limit);
    std::abort();
  }

 private:
  static constexpr double limit = 1.0;  // [s], under the sanitizers too
  std::clock_t start_ = std::clock();
};

/// Aborts with a message where a property does not hold.
inline void require_that(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", property);
  std::abort();
}

}  // namespace talus::fuzz
