#include "tools/serve/live_view.h"

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "common/text/printable.h"
#include "lcmtypes/live_link.h"
#include "tools/monitor/receive.h"
#include "tools/monitor/run_view.h"

namespace talus {
namespace {

/// The address to receive at, once it is known to work.
std::string working_address(const std::string& url) {
  check_url(url);
  std::string address = receiving_url(url);
  if (const LiveLink link = open_live_link(address); !link.lcm) throw std::runtime_error(link.problem);
  return address;
}

}  // namespace

LiveView::LiveView(const std::string& url, PageHub& hub)
    : receiver_(receive_at(working_address(url))), run_(hub, "waiting for a run on " + printable(effective_url(url))) {}

void LiveView::listen(std::chrono::milliseconds time) {
  using Clock = ReceiverProcess::Clock;
  const auto end = Clock::now() + time;
  for (auto now = Clock::now(); now < end; now = Clock::now()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - now);
    if (const auto datagram = receiver_.next(std::max(left, std::chrono::milliseconds(1)))) run_.hear(*datagram, now);
  }
}

}  // namespace talus
