#include "tools/monitor/receive.h"

#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <vector>

#include "lcmtypes/live_link.h"

namespace talus {
namespace {

// Messages of one channel that wait while the monitor stands still, at most; LCM's own 30 lose most of what arrives in
// one burst. Large: more memory under a flood.
constexpr int queue_capacity = 1000;
constexpr int sign_of_life_ms = 500;

struct Forwarder {
  const DatagramSender& sender;
  Channel channel;

  void forward(const lcm::ReceiveBuffer* buffer, const std::string&) {
    sender.send(channel, buffer->data, buffer->data_size);
  }
};

}  // namespace

void receive(lcm::LCM& lcm, std::span<const Channel> channels, const DatagramSender& sender) {
  std::vector<Forwarder> forwarders;
  forwarders.reserve(channels.size());  // LCM keeps their addresses
  for (const Channel channel : channels) {
    forwarders.push_back({sender, channel});
    lcm::Subscription* subscription = lcm.subscribe(name_of(channel), &Forwarder::forward, &forwarders.back());
    if (subscription == nullptr) throw std::runtime_error("LCM does not subscribe");
    subscription->setQueueCapacity(queue_capacity);
  }
  sender.alive();
  for (int heard = 0; heard >= 0;) {
    heard = lcm.handleTimeout(sign_of_life_ms);
    if (heard == 0) sender.alive();
  }
}

ReceiverProcess::Body receive_at(const std::string& address) {
  return [address](const DatagramSender& sender) {
    const LiveLink link = open_live_link(address);
    if (!link.lcm) throw std::runtime_error(link.problem);
    receive(*link.lcm, all_channels, sender);
    throw std::runtime_error("LCM stopped receiving");
  };
}

}  // namespace talus
