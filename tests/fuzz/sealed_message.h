#pragma once
// Messages made from fuzzed bytes, with a valid fingerprint and checksum where random bytes would never have them.

#include <cstdint>
#include <span>
#include <vector>

#include "lcmtypes/channels.h"

namespace talus::fuzz {

/// Fingerprint of the channel's type, `content`, checksum.
std::vector<std::uint8_t> sealed_message(Channel channel, std::span<const std::uint8_t> content);

}  // namespace talus::fuzz
