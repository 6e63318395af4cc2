#include "tools/monitor/listener.h"

#include <fmt/core.h>

#include <numeric>
#include <type_traits>

#include "lcmtypes/wire.h"

namespace talus {

void Listener::hear(const Datagram& datagram, Clock::time_point now) {
  with_message_of(datagram.channel, [&](auto message) { this->hear(datagram, message, now); });
}

template <class Message>
void Listener::hear(const Datagram& datagram, Message& message, Clock::time_point now) {
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
  if constexpr (std::is_same_v<Message, talus_lcm::talus_run>) {
    if (view.reader().is_restart(message)) runs_.restart(message.run_id);
  }
  view.take(message);
}

std::int64_t Listener::undecodable() const {
  return std::accumulate(undecodable_.begin(), undecodable_.end(), std::int64_t{0});
}

}  // namespace talus
