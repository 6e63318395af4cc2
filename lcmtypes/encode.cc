#include "lcmtypes/encode.h"

#include <fmt/core.h>
#include <zlib.h>

#include <cstdio>
#include <cstdlib>

namespace talus {
namespace {

void abort_with(const char* channel, std::size_t size) {
  fmt::print(stderr, "talus: a message of {} bytes for {}: at most {}, and every count must match\n", size, channel,
             max_message_bytes);
  std::abort();
}

/// Writes the checksum of all before it over the last four bytes, highest byte first as LCM does.
void put_checksum(std::span<std::uint8_t> bytes) {
  const auto body = bytes.first(bytes.size() - checksum_bytes);
  const std::uint32_t sum = checksum(body);
  const auto end = bytes.last(checksum_bytes);
  for (std::size_t i = 0; i < checksum_bytes; ++i)
    end[i] = static_cast<std::uint8_t>(sum >> (8 * (checksum_bytes - 1 - i)));
}

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
}

void renumber(std::span<std::uint8_t> bytes, std::int64_t seq) {
  const auto place = bytes.subspan(header_bytes - 8, 8);
  for (std::size_t i = 0; i < 8; ++i)
    place[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(seq) >> (8 * (7 - i)));
  put_checksum(bytes);
}

template <class Message>
Packet MessageEncoder::encode(Message& message, const Stamp& stamp) {
  constexpr Channel channel = channel_of<Message>;
  message.utime = stamp.utime;
  message.run_id = run_id_;
  message.step = stamp.step;
  message.sim_time = stamp.sim_time;
  message.seq = next_[static_cast<std::size_t>(channel)]++;
  message.crc32 = 0;
  Packet packet{channel, stamp.utime, {}};
  const int size = message.getEncodedSize();
  packet.bytes.resize(size);
  const int written = message.encode(packet.bytes.data(), 0, size);
  if (written != size || packet.bytes.size() > max_message_bytes) abort_with(name_of(channel), packet.bytes.size());
  put_checksum(packet.bytes);
  return packet;
}

// NOLINTNEXTLINE(bugprone-macro-parentheses): a type takes none
#define TALUS_ENCODE(Message) template Packet MessageEncoder::encode(Message&, const Stamp&);
TALUS_EACH_MESSAGE(TALUS_ENCODE)

}  // namespace talus
