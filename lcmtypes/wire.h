#pragma once
// From a message to the bytes that travel, and from bytes of unknown origin, of a forged packet or a damaged file, to a
// message that is safe to use.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lcmtypes/channels.h"

namespace talus {

/// An encoded message, ready for the wire or the record.
struct Packet {
  Channel channel = Channel::run;
  std::int64_t utime = 0;  // the message's own stamp [us]
  std::vector<std::uint8_t> bytes;
};

/// When a message is from.
struct Stamp {
  std::int64_t utime = 0;  // [us], see the .lcm files
  std::int64_t step = 0;
  double sim_time = 0.0;  // [s]
};

/// CRC-32 of zlib, at most 4 GB.
std::uint32_t checksum(std::span<const std::uint8_t> bytes);

/// Gives an encoded message another number on its channel, and the checksum that follows.
void renumber(std::span<std::uint8_t> bytes, std::int64_t seq);

/// Gives each message of a run its header, its number on its channel and its checksum.
class MessageEncoder {
 public:
  explicit MessageEncoder(std::int64_t run_id) : run_id_(run_id) {}

  /// Fills in the header and the checksum and encodes. A message above max_message_bytes is our own mistake: aborts.
  template <class Message>
  Packet encode(Message& message, const Stamp& stamp);

  /// Messages so far on a channel.
  std::int64_t sent(Channel channel) const { return next_[static_cast<std::size_t>(channel)]; }

 private:
  std::int64_t run_id_;
  std::array<std::int64_t, channel_names.size()> next_{};
};

/// Whether the bytes are of a size that a message can have and match the checksum at their end.
bool checksum_holds(std::span<const std::uint8_t> bytes);

/// Decodes `bytes` and returns what is wrong with them, or nothing (then `message` is safe to use). Checks size,
/// checksum, fingerprint and layout (layout.h: numbers are finite and booleans 0 or 1) before the generated decoder
/// runs, which would resize to a count of 2^31 at once; then that every value is within its range, by range_fault() of
/// the message. Throws nothing but bad_alloc.
template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message);

}  // namespace talus
