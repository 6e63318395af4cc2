#pragma once

#include "tools/monitor/receiver_process.h"

namespace lcm {
class LCM;
}

namespace talus {

/// Hands all messages on the channels that a monitor hears from `lcm` to `sender`. Returns when LCM stops receiving;
/// throws std::runtime_error when it does not begin.
void receive(lcm::LCM& lcm, const DatagramSender& sender);

}  // namespace talus
