#include "lcmtypes/encode.h"

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <span>

#include "lcmtypes/crc32.h"

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
  const std::uint32_t sum = crc32(body);
  const auto end = bytes.last(checksum_bytes);
  for (std::size_t i = 0; i < checksum_bytes; ++i) {
    end[i] = static_cast<std::uint8_t>(sum >> (8 * (checksum_bytes - 1 - i)));
  }
}

}  // namespace

template <class Message>
Packet Sealer::seal(Message& message, const Moment& moment) {
  constexpr Channel channel = channel_of<Message>;
  message.utime = moment.utime;
  message.run_id = run_id_;
  message.step = moment.step;
  message.sim_time = moment.sim_time;
  message.seq = next_[static_cast<std::size_t>(channel)]++;
  message.crc32 = 0;
  Packet packet{channel, moment.utime, {}};
  const int size = message.getEncodedSize();
  packet.bytes.resize(static_cast<std::size_t>(size));
  const int written = message.encode(packet.bytes.data(), 0, size);
  if (written != size || packet.bytes.size() > max_message_bytes) {
    abort_with(name_of(channel), packet.bytes.size());
  }
  put_checksum(packet.bytes);
  return packet;
}

template Packet Sealer::seal(talus_lcm::talus_run_v1&, const Moment&);
template Packet Sealer::seal(talus_lcm::talus_piles_v1&, const Moment&);
template Packet Sealer::seal(talus_lcm::talus_sleep_v1&, const Moment&);
template Packet Sealer::seal(talus_lcm::talus_stats_v1&, const Moment&);
template Packet Sealer::seal(talus_lcm::talus_stats_v2&, const Moment&);
template Packet Sealer::seal(talus_lcm::talus_bodies_v1&, const Moment&);
template Packet Sealer::seal(talus_lcm::talus_shapes_v1&, const Moment&);

}  // namespace talus
