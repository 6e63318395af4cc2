#pragma once
// From bytes that anybody may have sent, or a damaged file held, to a message that is safe to use.

#include <cstdint>
#include <span>
#include <string_view>

#include "lcmtypes/channels.h"

namespace talus {

/// Whether the bytes are of a size that a message can have and match the checksum at their end.
bool checksum_holds(std::span<const std::uint8_t> bytes);

/// Decodes `bytes` and returns what is wrong with them, or nothing (then `message` is safe to use). Checks size,
/// checksum, fingerprint and every count against the bytes left before the generated decoder runs (which would resize
/// to a count of 2^31 at once), then that every value is finite and within its range. Throws nothing but bad_alloc.
/// A talus_stats_v1 is taken for a talus_stats_v2 without what it does not have, so that old records still read.
template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message);

}  // namespace talus
