#include "tools/monitor/listener.h"

#include <fmt/core.h>

#include <type_traits>

#include "lcmtypes/decode.h"

namespace talus {

using talus_lcm::talus_piles_v1;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v1;

void Listener::hear(const Datagram& datagram, Clock::time_point now) {
  switch (datagram.channel) {
    case Channel::run:
      return hear<talus_run_v1>(datagram, now);
    case Channel::piles:
      return hear<talus_piles_v1>(datagram, now);
    case Channel::sleep:
      return hear<talus_sleep_v1>(datagram, now);
    case Channel::stats:
      return hear<talus_stats_v1>(datagram, now);
    default:
      return;
  }
}

template <class Message>
void Listener::hear(const Datagram& datagram, Clock::time_point now) {
  Message message{};
  const auto fault = decode(datagram.bytes, message);
  if (!fault.empty()) {
    ++undecodable_;
    last_fault_ = fmt::format("{}: {}", name_of(datagram.channel), fault);
    return;
  }
  RunView* view = runs_.find(message.run_id, now);
  if (view == nullptr) return;
  if constexpr (std::is_same_v<Message, talus_run_v1>) {
    if (view->is_restart(message)) runs_.restart(message.run_id);
  }
  view->take(message);
}

}  // namespace talus
