#pragma once

#include <chrono>
#include <string>

#include "tools/monitor/receiver_process.h"
#include "tools/serve/live_run.h"

namespace talus {

/// Shows the pages of a hub a run that another process publishes.
class LiveView {
 public:
  /// `url` as in receiving_url(). Starts a process that receives, so the caller should have one thread only. Throws
  /// std::invalid_argument on a bad address, std::runtime_error where nothing can be received.
  LiveView(const std::string& url, PageHub& hub);

  /// Takes what arrives within this time.
  void listen(std::chrono::milliseconds time);

 private:
  ReceiverProcess receiver_;
  LiveRun run_;
};

}  // namespace talus
