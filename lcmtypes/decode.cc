#include "lcmtypes/decode.h"

#include <type_traits>

#include "lcmtypes/big_endian.h"
#include "lcmtypes/encode.h"
#include "lcmtypes/ranges.h"

namespace talus {

using talus_lcm::talus_stats_v1;
using talus_lcm::talus_stats_v2;

namespace {

/// What has the same name in both versions; the rest as not known.
talus_stats_v2 newest(const talus_stats_v1& old) {
  talus_stats_v2 stats{};
  stats.utime = old.utime;
  stats.run_id = old.run_id;
  stats.step = old.step;
  stats.sim_time = old.sim_time;
  stats.seq = old.seq;
  stats.awake = old.awake;
  stats.asleep = old.asleep;
  stats.contacts = old.contacts;
  stats.kinetic_energy = old.kinetic_energy;
  stats.planned = -1;
  stats.appeared = -1;
  stats.timed = old.timed;
  stats.ms_emit = old.ms_emit;
  stats.ms_step = old.ms_step;
  stats.ms_collide = old.ms_collide;
  stats.ms_solve = old.ms_solve;
  stats.ms_read = old.ms_read;
  stats.ms_count = old.ms_count;
  stats.ms_decide = old.ms_decide;
  stats.ms_apply = old.ms_apply;
  stats.ms_observe = old.ms_observe;
  stats.real_time_factor = old.real_time_factor;
  stats.queued_bytes = old.queued_bytes;
  stats.dropped = old.dropped;
  stats.crc32 = old.crc32;
  return stats;
}

template <class Message>
bool is_of_type(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 8 && big_endian(bytes.first(8)) == static_cast<std::uint64_t>(Message::getHash());
}

}  // namespace

bool checksum_holds(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= header_bytes + checksum_bytes && bytes.size() <= max_message_bytes &&
         big_endian(bytes.last(checksum_bytes)) == checksum(bytes.first(bytes.size() - checksum_bytes));
}

template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message) {
  if (bytes.size() < header_bytes + checksum_bytes) return "too short";
  if (bytes.size() > max_message_bytes) return "too long";
  if constexpr (std::is_same_v<Message, talus_stats_v2>) {
    if (is_of_type<talus_stats_v1>(bytes)) {
      talus_stats_v1 old{};
      const std::string_view fault = decode(bytes, old);
      if (fault.empty()) message = newest(old);
      return fault;
    }
  }
  if (!is_of_type<Message>(bytes)) return "another type or version";
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
