#include "lcmtypes/run_message.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/text/printable.h"
#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_run;

talus_run to_run(const RunInfo& info, std::int8_t phase, std::string_view reason, std::span<const Channel> channels,
                 const MessageEncoder& encoder) {
  talus_run message{};
  message.format = talus_run::FORMAT;
  message.phase = phase;
  message.reason = clipped(reason);
  message.scene = clipped(info.scene);
  message.title = clipped(info.title);
  message.backend = clipped(info.backend);
  message.policy = clipped(info.policy);
  message.version = clipped(info.version);
  message.units = "SI";
  message.seed = static_cast<std::int64_t>(info.seed);
  message.dimension = info.dimension;
  message.dt = info.dt;
  message.steps = info.steps;
  message.tolerance = info.tolerance.value_or(-1.0);
  message.score_threshold = info.score_threshold.value_or(-1.0);
  std::copy(info.gravity.begin(), info.gravity.end(), message.gravity);
  message.ground = info.ground.present ? 1 : 0;
  message.ground_height = info.ground.present ? info.ground.height : 0.0;
  message.ground_friction = info.ground.material.friction;
  message.ground_restitution = info.ground.material.restitution;
  std::copy(info.sides.low.begin(), info.sides.low.end(), message.side);
  std::copy(info.sides.period.begin(), info.sides.period.end(), message.period);
  message.solver = clipped(info.solver.kind);
  message.sub_steps = info.solver.sub_steps;
  message.velocity_iterations = info.solver.velocity_iterations;
  message.position_iterations = info.solver.position_iterations;
  message.friction_directions = info.solver.friction_directions;
  message.restitution_threshold = info.solver.restitution_threshold;
  message.channel_count = static_cast<std::int32_t>(channels.size());
  for (const Channel channel : channels) {
    message.channels.emplace_back(name_of(channel));
    message.sent.push_back(encoder.sent(channel));
  }
  return message;
}

std::string_view range_fault(const talus_run& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.format != talus_run::FORMAT) return "another format";
  if (m.phase < talus_run::BEGIN || m.phase > talus_run::END) return "unknown phase";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.dt < 0 || m.dt == 0.0 || m.steps < 0) return "length out of range";
  if (m.ground_friction < 0 || m.ground_restitution < 0 || m.restitution_threshold < 0) return "world out of range";
  if (std::any_of(std::begin(m.period), std::end(m.period), is_negative)) return "period out of range";
  if (m.sub_steps < 0 || m.velocity_iterations < 0 || m.position_iterations < 0 || m.friction_directions < 0)
    return "solver out of range";
  if (!(m.tolerance >= 0.0 || m.tolerance == -1.0)) return "tolerance out of range";
  if (!(m.score_threshold >= 0.0 || m.score_threshold == -1.0)) return "threshold out of range";
  if (std::any_of(m.sent.begin(), m.sent.end(), is_negative)) return "negative number of messages";
  return {};
}

std::string text_of(const OtherFormat& other) {
  const std::string version = other.version.empty() ? "of an unknown version" : printable(other.version.substr(0, 100));
  return fmt::format("format {} of talus {}, must be format {}", other.format, version, talus_run::FORMAT);
}

std::optional<OtherFormat> other_format(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t text_at = header_bytes + 4 + 4;  // after the format and the length of the text
  if (!checksum_holds(bytes) || bytes.size() < text_at + checksum_bytes) return std::nullopt;
  const auto format = static_cast<std::int32_t>(big_endian(bytes.subspan(header_bytes, 4)));
  const auto fingerprint = static_cast<std::int64_t>(big_endian(bytes.first(fingerprint_bytes)));
  if (fingerprint == talus_run::getHash() && format == talus_run::FORMAT) return std::nullopt;
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

}  // namespace talus
