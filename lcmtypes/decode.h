#pragma once
// From bytes of unknown origin, of a forged packet or a damaged file, to a message that is safe to use.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lcmtypes/channels.h"

namespace talus {

/// The first value found that is out of its range, or nothing. Numbers are finite and booleans 0 or 1 (layout.h).
std::string_view range_fault(const talus_lcm::talus_run& message);
std::string_view range_fault(const talus_lcm::talus_piles& message);
std::string_view range_fault(const talus_lcm::talus_sleep& message);
std::string_view range_fault(const talus_lcm::talus_stats& message);
std::string_view range_fault(const talus_lcm::talus_bodies& message);
std::string_view range_fault(const talus_lcm::talus_shapes& message);
std::string_view range_fault(const talus_lcm::talus_event& message);
std::string_view range_fault(const talus_lcm::talus_obstacles& message);
std::string_view range_fault(const talus_lcm::talus_scene& message);

/// Whether the bytes are of a size that a message can have and match the checksum at their end.
bool checksum_holds(std::span<const std::uint8_t> bytes);

/// What a message on TALUS_RUN of another format than talus_run::FORMAT says of itself.
struct OtherFormat {
  std::int32_t format = 0;
  std::string version;  // of talus; any bytes
};
/// One line: "format 3 of talus 0.4, must be format 1".
std::string text_of(const OtherFormat& other);
/// Nothing where the bytes are damaged or of this format.
std::optional<OtherFormat> other_format(std::span<const std::uint8_t> bytes);
/// Throws std::invalid_argument where these are of a run of another format.
void refuse_other_format(Channel channel, std::span<const std::uint8_t> bytes);

/// Decodes `bytes` and returns what is wrong with them, or nothing (then `message` is safe to use). Checks size,
/// checksum, fingerprint and layout (layout.h) before the generated decoder runs, which would resize to a count of 2^31
/// at once; then that every value is within its range. Throws nothing but bad_alloc.
template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message);

}  // namespace talus
