#pragma once

#include <ctime>

namespace talus {

/// Processor time of this thread between laps [s]: what else the machine does lengthens it little.
class ProcessorWatch {
 public:
  double lap() {
    const double now = read();
    const double passed = now - last_;
    last_ = now;
    return passed;
  }

 private:
  static double read() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double last_ = read();
};

}  // namespace talus
