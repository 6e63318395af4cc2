#pragma once
// Messages made from fuzzed bytes, with a valid fingerprint and checksum where random bytes would never have them.

#include <cstdint>
#include <span>
#include <vector>

#include "lcmtypes/channels.h"

namespace talus::fuzz {

/// Calls `use` with a default message of the channel's type.
template <class Use>
void with_message_of(Channel channel, const Use& use) {
  switch (channel) {
    case Channel::run:
      return use(talus_lcm::talus_run_v1{});
    case Channel::piles:
      return use(talus_lcm::talus_piles_v2{});
    case Channel::sleep:
      return use(talus_lcm::talus_sleep_v1{});
    case Channel::stats:
      return use(talus_lcm::talus_stats_v2{});
    case Channel::bodies:
      return use(talus_lcm::talus_bodies_v1{});
    case Channel::shapes:
      return use(talus_lcm::talus_shapes_v1{});
    case Channel::events:
      return use(talus_lcm::talus_event_v2{});
  }
}

/// Fingerprint of the channel's type, `content`, checksum.
std::vector<std::uint8_t> sealed_message(Channel channel, std::span<const std::uint8_t> content);

}  // namespace talus::fuzz
