#include "lcmtypes/wire.h"

#include <fmt/core.h>
#include <zlib.h>

#include <cstdio>
#include <cstdlib>

#include "lcmtypes/bodies_message.h"
#include "lcmtypes/contacts_message.h"
#include "lcmtypes/event_message.h"
#include "lcmtypes/instruments_message.h"
#include "lcmtypes/obstacles_message.h"
#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/scene_message.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/stats_message.h"

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

bool checksum_holds(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= header_bytes + checksum_bytes && bytes.size() <= max_message_bytes &&
         big_endian(bytes.last(checksum_bytes)) == checksum(bytes.first(bytes.size() - checksum_bytes));
}

template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message) {
  if (bytes.size() < header_bytes + checksum_bytes) return "too short";
  if (bytes.size() > max_message_bytes) return "too long";
  if (big_endian(bytes.first(fingerprint_bytes)) != static_cast<std::uint64_t>(Message::getHash()))
    return "another type or version";
  if (!checksum_holds(bytes)) return "wrong checksum";
  if (const std::string_view fault = layout_fault(layout<Message>, bytes); !fault.empty()) return fault;
  const int size = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, size) != size) return "not decodable";
  return range_fault(message);
}

// NOLINTNEXTLINE(bugprone-macro-parentheses): a type takes none
#define TALUS_DECODE(Message) template std::string_view decode(std::span<const std::uint8_t>, Message&);
TALUS_EACH_MESSAGE(TALUS_DECODE)

}  // namespace talus
