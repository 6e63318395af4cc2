#include "tools/monitor/stop_signal.h"

#include <csignal>

namespace talus {
namespace {

// A signal handler reaches nothing but globals.
std::atomic<bool> stopped = false;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

const std::atomic<bool>& stop_signal() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { stopped = true; });
  return stopped;
}

}  // namespace talus
