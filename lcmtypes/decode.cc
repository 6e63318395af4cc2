#include "lcmtypes/decode.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

#include "lcmtypes/encode.h"
#include "lcmtypes/layout.h"

namespace talus {
namespace {

using talus_lcm::talus_bodies_v1;
using talus_lcm::talus_event_v1;
using talus_lcm::talus_event_v2;
using talus_lcm::talus_layer_v1;
using talus_lcm::talus_layer_v2;
using talus_lcm::talus_obstacles_v1;
using talus_lcm::talus_pile_v1;
using talus_lcm::talus_pile_v2;
using talus_lcm::talus_piles_v1;
using talus_lcm::talus_piles_v2;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_scene_v1;
using talus_lcm::talus_shapes_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v1;
using talus_lcm::talus_stats_v2;

// A layer of almost no volume at the apex, with a stream of bodies above it, reaches thousands.
constexpr float max_density = 1e9F;

constexpr auto is_index_or_none = [](std::int32_t value) { return value >= -1; };

constexpr auto is_negative = [](auto value) { return value < 0; };

bool ascend(const std::vector<std::int32_t>& numbers) {
  return std::ranges::adjacent_find(numbers, std::greater_equal()) == numbers.end();
}

/// What all messages have.
template <class Message>
bool header_holds(const Message& m) {
  return m.step >= 0 && m.seq >= 0 && m.sim_time >= 0.0;
}

template <class Message>
bool parts_hold(const Message& m) {
  return m.part >= 0 && m.part < m.parts;
}

bool threshold_holds(double threshold) { return threshold >= 0.0 || threshold == -1.0; }

bool layer_holds(const talus_layer_v2& layer) {
  return threshold_holds(layer.sleep_density) && threshold_holds(layer.wake_density) && layer.bottom >= 0 &&
         layer.top >= 0 && layer.radius >= 0 && layer.capacity >= 0 && layer.density >= 0 &&
         layer.density <= max_density && layer.sleeping >= 0 && layer.sleeping <= layer.count;
}

bool pile_holds(const talus_pile_v2& pile) {
  return pile.structure_size >= 0 && pile.lift >= 0 && pile.height >= 0 && pile.radius >= 0 &&
         pile.occupation_ratio >= 0 && pile.merged_into >= -1 && pile.layer_count <= pile.layer_total &&
         std::all_of(pile.layers.begin(), pile.layers.end(), layer_holds);
}

/// Values of one piece: exactly so many, or for a hull a whole number of corners.
bool piece_length_holds(int kind, int length, int dimension) {
  const int turn = dimension == 2 ? 1 : 4;
  switch (kind) {
    case talus_shapes_v1::BOX:
      return length == 2 * dimension + turn;
    case talus_shapes_v1::BALL:
      return length == dimension + 1;
    case talus_shapes_v1::CAPSULE:
      return length == 2 * dimension + 1;
    case talus_shapes_v1::HULL:
      return length > dimension * dimension && length % dimension == 0;
    default:
      return false;
  }
}

/// What both versions of the statistics have.
template <class Message>
std::string_view stats_fault(const Message& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.awake < 0 || m.asleep < 0 || m.contacts < -1) return "negative count";
  if (m.kinetic_energy < 0) return "kinetic energy out of range";
  for (const float value : {m.ms_emit, m.ms_step, m.ms_collide, m.ms_solve, m.ms_read, m.ms_count, m.ms_decide,
                            m.ms_apply, m.ms_observe, m.real_time_factor}) {
    if (value < 0) return "time out of range";
  }
  if (m.queued_bytes < 0 || m.dropped < 0) return "negative count";
  return {};
}

/// The header and the checksum.
template <class Old, class Message>
void take_frame(const Old& old, Message& message) {
  message.utime = old.utime;
  message.run_id = old.run_id;
  message.step = old.step;
  message.sim_time = old.sim_time;
  message.seq = old.seq;
  message.crc32 = old.crc32;
}

// newest(): what has the same name in both versions; the rest as not known.

talus_stats_v2 newest(const talus_stats_v1& old) {
  talus_stats_v2 stats{};
  take_frame(old, stats);
  stats.awake = old.awake;
  stats.asleep = old.asleep;
  stats.contacts = old.contacts;
  stats.kinetic_energy = old.kinetic_energy;
  stats.planned = -1;
  stats.appeared = -1;
  stats.drift_estimate = -1.0;
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
  return stats;
}

talus_layer_v2 newest(const talus_layer_v1& old) {
  talus_layer_v2 layer{};
  layer.bottom = old.bottom;
  layer.top = old.top;
  layer.radius = old.radius;
  layer.capacity = old.capacity;
  layer.density = old.density;
  layer.sleep_density = layer.wake_density = -1.0F;
  layer.count = old.count;
  layer.sleeping = old.sleeping;
  return layer;
}

talus_pile_v2 newest(const talus_pile_v1& old) {
  talus_pile_v2 pile{};
  std::copy(std::begin(old.centre), std::end(old.centre), std::begin(pile.centre));
  pile.alpha = old.alpha;
  pile.structure_size = old.structure_size;
  pile.lift = old.lift;
  pile.height = old.height;
  pile.radius = old.radius;
  pile.occupation_ratio = old.occupation_ratio;
  pile.merged_into = old.merged_into;
  pile.layer_total = old.layer_total;
  pile.layer_count = old.layer_count;
  for (const talus_layer_v1& layer : old.layers) pile.layers.push_back(newest(layer));
  return pile;
}

talus_piles_v2 newest(const talus_piles_v1& old) {
  talus_piles_v2 piles{};
  take_frame(old, piles);
  piles.part = old.part;
  piles.parts = old.parts;
  piles.first_pile = old.first_pile;
  piles.pile_total = old.pile_total;
  piles.pile_count = old.pile_count;
  for (const talus_pile_v1& pile : old.piles) piles.piles.push_back(newest(pile));
  return piles;
}

/// An old message has the time at the end of the step before which the event happened.
talus_event_v2 newest(const talus_event_v1& old) {
  talus_event_v2 event{};
  take_frame(old, event);
  event.number = old.number;
  event.total = -1;
  event.happened_step = old.step;
  event.happened_time = old.sim_time;
  event.action = old.action;
  event.text = old.text;
  return event;
}

/// The version before; the type itself where there is none.
template <class Message>
struct VersionBefore {
  using Type = Message;
};
template <>
struct VersionBefore<talus_piles_v2> {
  using Type = talus_piles_v1;
};
template <>
struct VersionBefore<talus_stats_v2> {
  using Type = talus_stats_v1;
};
template <>
struct VersionBefore<talus_event_v2> {
  using Type = talus_event_v1;
};

}  // namespace

std::string_view range_fault(const talus_run_v1& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.phase < talus_run_v1::BEGIN || m.phase > talus_run_v1::END) return "unknown phase";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.dt < 0 || m.dt == 0.0 || m.steps < 0) return "length out of range";
  if (m.gravity < 0) return "world out of range";
  if (std::any_of(m.sent.begin(), m.sent.end(), is_negative)) return "negative number of messages";
  return {};
}

std::string_view range_fault(const talus_piles_v1& m) { return range_fault(newest(m)); }

std::string_view range_fault(const talus_piles_v2& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.first_pile < 0 || std::int64_t{m.first_pile} + m.pile_count > m.pile_total) return "piles out of range";
  if (!std::all_of(m.piles.begin(), m.piles.end(), pile_holds)) return "pile out of range";
  return {};
}

std::string_view range_fault(const talus_sleep_v1& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (std::any_of(m.body.begin(), m.body.end(), is_negative)) return "negative body";
  if (!std::all_of(m.pile.begin(), m.pile.end(), is_index_or_none)) return "pile out of range";
  if (!std::all_of(m.layer.begin(), m.layer.end(), is_index_or_none)) return "layer out of range";
  const auto known = [](std::int8_t cause) { return cause >= talus_sleep_v1::SCORE && cause <= talus_sleep_v1::CHECK; };
  if (!std::all_of(m.cause.begin(), m.cause.end(), known)) return "unknown cause";
  return {};
}

std::string_view range_fault(const talus_event_v1& m) { return range_fault(newest(m)); }

std::string_view range_fault(const talus_event_v2& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.number < 0 || m.total < -1) return "negative number";
  if (m.happened_step < -1 || !(m.happened_time >= 0.0 || m.happened_time == -1.0)) return "time out of range";
  if (std::any_of(m.removed.begin(), m.removed.end(), is_negative)) return "negative obstacle";
  return {};
}

std::string_view range_fault(const talus_stats_v1& m) { return stats_fault(m); }

std::string_view range_fault(const talus_stats_v2& m) {
  if (m.planned < -1 || m.appeared < -1) return "negative count";
  if (!(m.drift_estimate >= 0.0 || m.drift_estimate == -1.0)) return "estimate of drift out of range";
  if (!(m.checked_share >= 0.0 && m.checked_share <= 1.0)) return "share out of range";
  if (!(m.overlap >= 0.0)) return "overlap out of range";
  if (!(m.overlap_share >= 0.0 && m.overlap_share <= 1.0)) return "share out of range";
  if (m.warning_count > talus_stats_v2::OVERLAP + 1) return "more warnings than kinds";
  const auto known = [](auto kind) { return kind >= talus_stats_v2::BELOW_GROUND && kind <= talus_stats_v2::OVERLAP; };
  if (!std::all_of(m.warning_kind.begin(), m.warning_kind.end(), known)) return "unknown kind of warning";
  if (std::any_of(m.warning_step.begin(), m.warning_step.end(), is_negative)) return "negative step of a warning";
  if (std::any_of(m.warning_bodies.begin(), m.warning_bodies.end(), is_negative)) return "negative count";
  if (!std::all_of(m.warning_body.begin(), m.warning_body.end(), is_index_or_none)) return "body out of range";
  return stats_fault(m);
}

std::string_view range_fault(const talus_bodies_v1& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.value_count != m.body_count * (m.dimension == 2 ? 3 : 7)) return "values do not match bodies";
  if (!ascend(m.body)) return "bodies not ascending";
  if (m.body_count > 0 && m.body.front() < 0) return "negative body";
  if (std::any_of(m.shape.begin(), m.shape.end(), is_negative)) return "negative shape";
  return {};
}

std::string_view range_fault(const talus_obstacles_v1& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.value_count != m.obstacle_count * (m.dimension == 2 ? 3 : 7)) return "values do not match obstacles";
  if (!ascend(m.obstacle)) return "obstacles not ascending";
  if (m.obstacle_count > 0 && m.obstacle.front() < 0) return "negative obstacle";
  return {};
}

std::string_view range_fault(const talus_scene_v1& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  return {};
}

std::string_view range_fault(const talus_shapes_v1& m) {
  if (!header_holds(m) || m.index < 0 || m.index >= m.total) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.density < 0 || m.friction < 0 || m.restitution < 0) return "bad material";
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < m.kind.size(); ++i) {
    if (!piece_length_holds(m.kind[i], m.length[i], m.dimension)) return "piece of a wrong length";
    sum += m.length[i];
  }
  if (sum != m.value_count) return "values do not match pieces";
  return {};
}

namespace {

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
  using Before = typename VersionBefore<Message>::Type;
  if constexpr (!std::is_same_v<Message, Before>) {
    if (is_of_type<Before>(bytes)) {
      Before old{};
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
