#pragma once
// From bytes of unknown origin, of a forged packet or a damaged file, to a message that is safe to use.

#include <cstdint>
#include <span>
#include <string_view>

#include "lcmtypes/channels.h"

namespace talus {

/// The first value found that is out of its range, or nothing. Numbers are finite and booleans 0 or 1 (layout.h).
std::string_view range_fault(const talus_lcm::talus_run_v1& message);
std::string_view range_fault(const talus_lcm::talus_piles_v1& message);
std::string_view range_fault(const talus_lcm::talus_piles_v2& message);
std::string_view range_fault(const talus_lcm::talus_sleep_v1& message);
std::string_view range_fault(const talus_lcm::talus_stats_v1& message);
std::string_view range_fault(const talus_lcm::talus_stats_v2& message);
std::string_view range_fault(const talus_lcm::talus_bodies_v1& message);
std::string_view range_fault(const talus_lcm::talus_shapes_v1& message);
std::string_view range_fault(const talus_lcm::talus_event_v1& message);
std::string_view range_fault(const talus_lcm::talus_event_v2& message);
std::string_view range_fault(const talus_lcm::talus_obstacles_v1& message);
std::string_view range_fault(const talus_lcm::talus_scene_v1& message);

/// Whether the bytes are of a size that a message can have and match the checksum at their end.
bool checksum_holds(std::span<const std::uint8_t> bytes);

/// Decodes `bytes` and returns what is wrong with them, or nothing (then `message` is safe to use). Checks size,
/// checksum, fingerprint and layout (layout.h) before the generated decoder runs, which would resize to a count of 2^31
/// at once; then that every value is within its range. Throws nothing but bad_alloc. A message of the
/// version before is decoded as one of this version without the fields that it does not have, so that old records can
/// be read.
template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message);

}  // namespace talus
