#include "tests/fuzz/sealed_message.h"

#include "lcmtypes/wire.h"

namespace talus::fuzz {
namespace {

// Resized once: this is the inner loop of two targets.
void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint64_t value, std::size_t size) {
  const std::size_t before = bytes.size();
  bytes.resize(before + size);
  for (std::size_t i = 0; i < size; ++i) bytes[before + i] = static_cast<std::uint8_t>(value >> (8 * (size - 1 - i)));
}

}  // namespace

std::vector<std::uint8_t> sealed_message(Channel channel, std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(content.size() + 8 + checksum_bytes);
  with_message_of(channel, [&bytes]<class Message>(const Message&) {
    append_big_endian(bytes, static_cast<std::uint64_t>(Message::getHash()), 8);
  });
  bytes.insert(bytes.end(), content.begin(), content.end());
  append_big_endian(bytes, checksum(bytes), checksum_bytes);
  return bytes;
}

}  // namespace talus::fuzz
