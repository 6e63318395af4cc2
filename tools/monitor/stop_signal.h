#pragma once

#include <atomic>

namespace talus {

/// From the first call on, true once SIGINT or SIGTERM has come, which then do nothing else.
const std::atomic<bool>& stop_signal();

}  // namespace talus
