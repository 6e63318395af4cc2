#include "lcmtypes/decode.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "common/text/printable.h"
#include "lcmtypes/encode.h"
#include "lcmtypes/layout.h"

namespace talus {
namespace {

using talus_lcm::talus_bodies;
using talus_lcm::talus_event;
using talus_lcm::talus_layer;
using talus_lcm::talus_obstacles;
using talus_lcm::talus_pile;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_scene;
using talus_lcm::talus_shapes;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;

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

bool layer_holds(const talus_layer& layer) {
  return threshold_holds(layer.sleep_density) && threshold_holds(layer.wake_density) && layer.bottom >= 0 &&
         layer.top >= 0 && layer.radius >= 0 && layer.capacity >= 0 && layer.density >= 0 &&
         layer.density <= max_density && layer.sleeping >= 0 && layer.sleeping <= layer.count;
}

bool pile_holds(const talus_pile& pile) {
  return pile.structure_size >= 0 && pile.lift >= 0 && pile.height >= 0 && pile.radius >= 0 &&
         pile.occupation_ratio >= 0 && pile.merged_into >= -1 && pile.layer_count <= pile.layer_total &&
         std::all_of(pile.layers.begin(), pile.layers.end(), layer_holds);
}

/// Values of one piece: exactly so many, or for a hull a whole number of corners.
bool piece_length_holds(int kind, int length, int dimension) {
  const int turn = dimension == 2 ? 1 : 4;
  switch (kind) {
    case talus_shapes::BOX:
      return length == 2 * dimension + turn;
    case talus_shapes::BALL:
      return length == dimension + 1;
    case talus_shapes::CAPSULE:
      return length == 2 * dimension + 1;
    case talus_shapes::HULL:
      return length > dimension * dimension && length % dimension == 0;
    default:
      return false;
  }
}

/// "#rrggbb" or empty.
bool colour_holds(std::string_view colour) {
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  return colour.empty() ||
         (colour.size() == 7 && colour[0] == '#' && colour.find_first_not_of(digits, 1) == std::string_view::npos);
}

}  // namespace

std::string_view range_fault(const talus_run& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.format != talus_run::FORMAT) return "another format";
  if (m.phase < talus_run::BEGIN || m.phase > talus_run::END) return "unknown phase";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.dt < 0 || m.dt == 0.0 || m.steps < 0) return "length out of range";
  if (m.ground_friction < 0 || m.ground_restitution < 0 || m.restitution_threshold < 0) return "world out of range";
  if (m.velocity_iterations < 0 || m.position_iterations < 0 || m.friction_directions < 0) return "solver out of range";
  if (!(m.tolerance >= 0.0 || m.tolerance == -1.0)) return "tolerance out of range";
  if (!(m.score_threshold >= 0.0 || m.score_threshold == -1.0)) return "threshold out of range";
  if (std::any_of(m.sent.begin(), m.sent.end(), is_negative)) return "negative number of messages";
  return {};
}

std::string_view range_fault(const talus_piles& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.first_pile < 0 || std::int64_t{m.first_pile} + m.pile_count > m.pile_total) return "piles out of range";
  if (!std::all_of(m.piles.begin(), m.piles.end(), pile_holds)) return "pile out of range";
  return {};
}

std::string_view range_fault(const talus_sleep& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (std::any_of(m.body.begin(), m.body.end(), is_negative)) return "negative body";
  if (!std::all_of(m.pile.begin(), m.pile.end(), is_index_or_none)) return "pile out of range";
  if (!std::all_of(m.layer.begin(), m.layer.end(), is_index_or_none)) return "layer out of range";
  const auto known = [](std::int8_t cause) { return cause >= talus_sleep::SCORE && cause <= talus_sleep::CHECK; };
  if (!std::all_of(m.cause.begin(), m.cause.end(), known)) return "unknown cause";
  return {};
}

std::string_view range_fault(const talus_event& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.number < 0 || m.number >= m.total) return "number out of range";
  if (m.happened_step < -1 || !(m.happened_time >= 0.0 || m.happened_time == -1.0)) return "time out of range";
  if (std::any_of(m.removed.begin(), m.removed.end(), is_negative)) return "negative obstacle";
  return {};
}

std::string_view range_fault(const talus_stats& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.awake < 0 || m.asleep < 0 || m.contacts < -1) return "negative count";
  if (m.kinetic_energy < 0) return "kinetic energy out of range";
  if (m.planned < 0 || m.appeared < 0) return "negative count";
  if (!(m.drift_estimate >= 0.0 || m.drift_estimate == -1.0)) return "estimate of drift out of range";
  if (!(m.checked_share >= 0.0 && m.checked_share <= 1.0)) return "share out of range";
  if (!(m.overlap >= 0.0)) return "overlap out of range";
  if (!(m.overlap_share >= 0.0 && m.overlap_share <= 1.0)) return "share out of range";
  if (!((m.slope >= 0.0 && m.slope <= std::numbers::pi / 2.0) || m.slope == -1.0)) return "slope out of range";
  if (m.warning_count > talus_stats::OVERLAP + 1) return "more warnings than kinds";
  const auto known = [](auto kind) { return kind >= talus_stats::BELOW_GROUND && kind <= talus_stats::OVERLAP; };
  if (!std::all_of(m.warning_kind.begin(), m.warning_kind.end(), known)) return "unknown kind of warning";
  if (std::any_of(m.warning_step.begin(), m.warning_step.end(), is_negative)) return "negative step of a warning";
  if (std::any_of(m.warning_bodies.begin(), m.warning_bodies.end(), is_negative)) return "negative count";
  if (!std::all_of(m.warning_body.begin(), m.warning_body.end(), is_index_or_none)) return "body out of range";
  for (const float value : {m.ms_emit, m.ms_step, m.ms_collide, m.ms_solve, m.ms_read, m.ms_count, m.ms_decide,
                            m.ms_apply, m.ms_observe, m.real_time_factor}) {
    if (value < 0) return "time out of range";
  }
  if (m.queued_bytes < 0 || m.dropped < 0) return "negative count";
  return {};
}

std::string_view range_fault(const talus_bodies& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.value_count != m.body_count * (m.dimension == 2 ? 3 : 7)) return "values do not match bodies";
  if (!ascend(m.body)) return "bodies not ascending";
  if (m.body_count > 0 && m.body.front() < 0) return "negative body";
  if (std::any_of(m.shape.begin(), m.shape.end(), is_negative)) return "negative shape";
  return {};
}

std::string_view range_fault(const talus_obstacles& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.value_count != m.obstacle_count * (m.dimension == 2 ? 3 : 7)) return "values do not match obstacles";
  if (!ascend(m.obstacle)) return "obstacles not ascending";
  if (m.obstacle_count > 0 && m.obstacle.front() < 0) return "negative obstacle";
  return {};
}

std::string_view range_fault(const talus_scene& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  return {};
}

std::string_view range_fault(const talus_shapes& m) {
  if (!header_holds(m) || m.index < 0 || m.index >= m.total) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.density < 0 || m.friction < 0 || m.restitution < 0 || m.rolling_friction < 0) return "bad material";
  if (m.volume < 0) return "negative volume";
  if (!colour_holds(m.colour)) return "bad colour";
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

std::string text_of(const OtherFormat& other) {
  const std::string version = other.version.empty() ? "an unknown version" : printable(other.version.substr(0, 100));
  return fmt::format("format {} of talus {}, must be format {}", other.format, version, talus_run::FORMAT);
}

std::optional<OtherFormat> other_format(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t text_at = header_bytes + 4 + 4;  // after the format and the length of the text
  if (!checksum_holds(bytes) || bytes.size() < text_at + checksum_bytes) return std::nullopt;
  const auto format = static_cast<std::int32_t>(big_endian(bytes.subspan(header_bytes, 4)));
  if (is_of_type<talus_run>(bytes) && format == talus_run::FORMAT) return std::nullopt;
  OtherFormat other{.format = format, .version = {}};
  const std::size_t length = big_endian(bytes.subspan(header_bytes + 4, 4));  // with the final zero byte
  if (length > 0 && length <= bytes.size() - checksum_bytes - text_at) {
    const auto text = bytes.subspan(text_at, length - 1);
    other.version.assign(text.begin(), text.end());
  }
  return other;
}

void refuse_other_format(Channel channel, std::span<const std::uint8_t> bytes) {
  if (channel != Channel::run) return;
  if (const auto other = other_format(bytes))
    throw std::invalid_argument(fmt::format("{}; run the scene again", text_of(*other)));
}

template <class Message>
std::string_view decode(std::span<const std::uint8_t> bytes, Message& message) {
  if (bytes.size() < header_bytes + checksum_bytes) return "too short";
  if (bytes.size() > max_message_bytes) return "too long";
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
