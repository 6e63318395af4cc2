#include "tests/fuzz/sealed_message.h"

#include "lcmtypes/crc32.h"

namespace talus::fuzz {
namespace {

void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

std::vector<std::uint8_t> sealed_message(Channel channel, std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes;
  with_message_of(channel, [&bytes]<class Message>(const Message&) {
    append_big_endian(bytes, static_cast<std::uint64_t>(Message::getHash()), 8);
  });
  bytes.insert(bytes.end(), content.begin(), content.end());
  append_big_endian(bytes, crc32(bytes), checksum_bytes);
  return bytes;
}

}  // namespace talus::fuzz
