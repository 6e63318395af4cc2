#pragma once

#include <span>
#include <string>

#include "tools/monitor/receiver_process.h"

namespace lcm {
class LCM;
}

namespace talus {

/// Hands all messages on `channels` from `lcm` to `sender`. Returns when LCM stops receiving; throws std::runtime_error
/// when it does not begin.
void receive(lcm::LCM& lcm, std::span<const Channel> channels, const DatagramSender& sender);

/// Hands all messages from an address of LCM on; throws std::runtime_error when that ends.
ReceiverProcess::Body receive_at(const std::string& address);

}  // namespace talus
