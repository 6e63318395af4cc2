#include "lcmtypes/decode.h"

#include "lcmtypes/big_endian.h"
#include "lcmtypes/crc32.h"
#include "lcmtypes/ranges.h"
#include "lcmtypes/scanner.h"

namespace talus {

bool checksum_holds(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= header_bytes + checksum_bytes && bytes.size() <= max_message_bytes &&
         big_endian(bytes.last(checksum_bytes)) == crc32(bytes.first(bytes.size() - checksum_bytes));
}

template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message) {
  if (bytes.size() < header_bytes + checksum_bytes) return "too short";
  if (bytes.size() > max_message_bytes) return "too long";
  if (big_endian(bytes.first(8)) != static_cast<std::uint64_t>(Message::getHash())) return "another type or version";
  if (!checksum_holds(bytes)) return "wrong checksum";
  if (!counts_fit<Message>(bytes)) return "counts do not match the size";
  const int size = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, size) != size) return "not decodable";
  return range_fault(message);
}

template std::string_view decode(std::span<const std::uint8_t>, talus_lcm::talus_run_v1&);
template std::string_view decode(std::span<const std::uint8_t>, talus_lcm::talus_piles_v1&);
template std::string_view decode(std::span<const std::uint8_t>, talus_lcm::talus_sleep_v1&);
template std::string_view decode(std::span<const std::uint8_t>, talus_lcm::talus_stats_v1&);
template std::string_view decode(std::span<const std::uint8_t>, talus_lcm::talus_bodies_v1&);
template std::string_view decode(std::span<const std::uint8_t>, talus_lcm::talus_shapes_v1&);

}  // namespace talus
