#include "tools/monitor/listener.h"

#include <fmt/core.h>

#include <numeric>
#include <type_traits>

#include "lcmtypes/decode.h"

namespace talus {

using talus_lcm::talus_bodies_v1;
using talus_lcm::talus_event_v2;
using talus_lcm::talus_piles_v2;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_shapes_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v2;

void Listener::hear(const Datagram& datagram, Clock::time_point now) {
  switch (datagram.channel) {
    case Channel::run:
      return hear<talus_run_v1>(datagram, now);
    case Channel::piles:
      return hear<talus_piles_v2>(datagram, now);
    case Channel::sleep:
      return hear<talus_sleep_v1>(datagram, now);
    case Channel::stats:
      return hear<talus_stats_v2>(datagram, now);
    case Channel::bodies:
      return hear<talus_bodies_v1>(datagram, now);
    case Channel::shapes:
      return hear<talus_shapes_v1>(datagram, now);
    case Channel::events:
      return hear<talus_event_v2>(datagram, now);
  }
}

template <class Message>
void Listener::hear(const Datagram& datagram, Clock::time_point now) {
  Message message{};
  const auto fault = decode(datagram.bytes, message);
  if (!fault.empty()) {
    ++undecodable_[static_cast<std::size_t>(datagram.channel)];
    last_fault_ = fmt::format("{}: {}", name_of(datagram.channel), fault);
    return;
  }
  RunTable::Entry* entry = runs_.find(message.run_id, now);
  if (entry == nullptr) return;
  entry->rates[static_cast<std::size_t>(datagram.channel)].add(datagram.bytes.size(), now);
  RunView& view = entry->view;
  if constexpr (std::is_same_v<Message, talus_run_v1>) {
    if (view.is_restart(message)) runs_.restart(message.run_id);
  }
  view.take(message);
}

std::int64_t Listener::undecodable() const {
  return std::accumulate(undecodable_.begin(), undecodable_.end(), std::int64_t{0});
}

}  // namespace talus
