#include "lcmtypes/translate.h"

#include <algorithm>
#include <cmath>

#include "common/world/energy.h"

namespace talus {

using talus_lcm::talus_bodies_v1;
using talus_lcm::talus_layer_v1;
using talus_lcm::talus_pile_v1;
using talus_lcm::talus_piles_v1;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_sleep_v1;
using talus_lcm::talus_stats_v2;

namespace {

constexpr std::size_t layer_bytes = fixed_bytes(layout<talus_layer_v1>);
constexpr std::size_t pile_bytes = fixed_bytes(layout<talus_pile_v1>);  // without its layers
constexpr std::size_t event_bytes = bytes_per_entry(layout<talus_sleep_v1>, "event_count");

/// Bytes that a message of fixed and counted fields has for the counted ones.
template <class Message>
constexpr std::size_t room = max_message_bytes - fingerprint_bytes - fixed_bytes(layout<Message>);
static_assert(pile_bytes + max_layers * layer_bytes <= room<talus_piles_v1>);

template <int Dim>
constexpr std::size_t pose_values = Dim == 2 ? 3 : 7;

/// Texts come from scene files and error messages; a message must stay small whatever they hold.
std::string clipped(std::string_view text) { return std::string(text.substr(0, 1000)); }

/// Numbers the parts of one frame.
template <class Message>
std::vector<Message> numbered(std::vector<Message> messages) {
  for (std::size_t i = 0; i < messages.size(); ++i) {
    messages[i].part = static_cast<std::int32_t>(i);
    messages[i].parts = static_cast<std::int32_t>(messages.size());
  }
  return messages;
}

talus_layer_v1 to_layer(const Layer& layer) {
  talus_layer_v1 message{};
  message.bottom = static_cast<float>(layer.bottom);
  message.top = static_cast<float>(layer.top);
  message.radius = static_cast<float>(std::max(0.0, layer.radius));
  message.capacity = static_cast<float>(layer.capacity);
  message.density = static_cast<float>(layer.density());
  message.count = layer.count;
  message.sleeping = layer.sleeping;
  return message;
}

template <int Dim>
talus_pile_v1 to_pile(const Pile<Dim>& pile) {
  talus_pile_v1 message{};
  message.centre[0] = pile.centre[0];
  message.centre[1] = Dim == 2 ? 0.0 : pile.centre[1];
  message.centre[2] = height<Dim>(pile.centre);
  message.alpha = pile.alpha;
  message.structure_size = pile.structure_size;
  message.lift = pile.lift;
  message.height = pile.height;
  message.radius = pile.radius;
  message.occupation_ratio = pile.occupation_ratio();
  message.merged_into = pile.merged_into;
  message.layer_total = static_cast<std::int32_t>(pile.layers.size());
  for (const Layer& layer : std::span(pile.layers).first(std::min(pile.layers.size(), max_layers))) {
    message.layers.push_back(to_layer(layer));
  }
  message.layer_count = static_cast<std::int32_t>(message.layers.size());
  return message;
}

template <int Dim>
void append(const Pose<Dim>& pose, std::vector<float>& values) {
  for (const double x : pose.position) {
    values.push_back(static_cast<float>(x));
  }
  if constexpr (Dim == 2) {
    values.push_back(static_cast<float>(pose.rotation.angle()));
  } else {
    for (const double part : {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()}) {
      values.push_back(static_cast<float>(part));
    }
  }
}

}  // namespace

talus_run_v1 to_run(const RunInfo& info, std::int8_t phase, std::string_view reason, std::span<const Channel> channels,
                    const MessageEncoder& encoder) {
  talus_run_v1 message{};
  message.phase = phase;
  message.reason = clipped(reason);
  message.scene = clipped(info.scene);
  message.backend = clipped(info.backend);
  message.policy = clipped(info.policy);
  message.version = clipped(info.version);
  message.units = "SI";
  message.seed = static_cast<std::int64_t>(info.seed);
  message.dimension = info.dimension;
  message.dt = info.dt;
  message.steps = info.steps;
  message.gravity = info.gravity;
  message.ground = info.ground ? 1 : 0;
  message.ground_height = info.ground_height;
  message.channel_count = static_cast<std::int32_t>(channels.size());
  for (const Channel channel : channels) {
    message.channels.emplace_back(name_of(channel));
    message.sent.push_back(encoder.sent(channel));
  }
  return message;
}

template <int Dim>
std::vector<talus_piles_v1> to_piles(std::span<const Pile<Dim>> piles) {
  std::vector<talus_piles_v1> messages(1);
  std::size_t used = 0;
  for (std::size_t i = 0; i < piles.size(); ++i) {
    talus_pile_v1 pile = to_pile(piles[i]);
    const std::size_t bytes = pile_bytes + pile.layers.size() * layer_bytes;
    if (used + bytes > room<talus_piles_v1>) {
      messages.emplace_back().first_pile = static_cast<std::int32_t>(i);
      used = 0;
    }
    used += bytes;
    messages.back().piles.push_back(std::move(pile));
  }
  for (talus_piles_v1& message : messages) {
    message.pile_total = static_cast<std::int32_t>(piles.size());
    message.pile_count = static_cast<std::int32_t>(message.piles.size());
  }
  return numbered(std::move(messages));
}

std::vector<talus_sleep_v1> to_sleep(std::span<const SleepEvent> events) {
  std::vector<talus_sleep_v1> messages;
  for (; !events.empty(); events = events.subspan(messages.back().event_count)) {
    talus_sleep_v1& message = messages.emplace_back();
    for (const SleepEvent& event : events.first(std::min(events.size(), room<talus_sleep_v1> / event_bytes))) {
      message.body.push_back(event.body);
      message.pile.push_back(event.pile);
      message.layer.push_back(event.layer);
      message.woke.push_back(event.woke ? 1 : 0);
      message.cause.push_back(static_cast<std::int8_t>(event.cause));
      message.score.push_back(static_cast<float>(event.score));
    }
    message.event_count = static_cast<std::int32_t>(message.body.size());
  }
  return numbered(std::move(messages));
}

template <int Dim>
talus_stats_v2 to_stats(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  talus_stats_v2 message{};
  const auto removed = std::count(states.removed.begin(), states.removed.end(), 1);
  message.awake = static_cast<std::int32_t>(frame.world.awake().size());
  message.asleep = states.size() - message.awake - static_cast<std::int32_t>(removed);
  message.contacts = -1;
  message.kinetic_energy = kinetic_energy(frame.world);
  message.planned = frame.bodies_asked;
  message.appeared = states.size();
  for (const Warning& warning : frame.warnings) {
    message.warning_kind.push_back(static_cast<std::int8_t>(warning.kind));
    message.warning_step.push_back(warning.step);
    message.warning_body.push_back(warning.body);
    message.warning_bodies.push_back(warning.bodies);
    message.warning_value.push_back(warning.value);
  }
  message.warning_count = static_cast<std::int32_t>(frame.warnings.size());
  return message;
}

std::vector<Warning> warnings_of(const talus_stats_v2& message) {
  std::vector<Warning> warnings;
  for (std::size_t i = 0; i < message.warning_kind.size(); ++i) {
    warnings.push_back({.kind = static_cast<WarningKind>(message.warning_kind[i]),
                        .step = message.warning_step[i],
                        .body = message.warning_body[i],
                        .bodies = message.warning_bodies[i],
                        .value = message.warning_value[i]});
  }
  return warnings;
}

template <int Dim>
std::vector<talus_bodies_v1> to_bodies(const BodyStates<Dim>& states, std::span<const BodyIndex> bodies,
                                       bool key_frame) {
  constexpr std::span fields = layout<talus_bodies_v1>;
  constexpr std::size_t at_most = room<talus_bodies_v1> / (bytes_per_entry(fields, "body_count") +
                                                           pose_values<Dim> * bytes_per_entry(fields, "value_count"));
  std::vector<talus_bodies_v1> messages;
  do {
    const auto here = bodies.first(std::min(bodies.size(), at_most));
    bodies = bodies.subspan(here.size());
    talus_bodies_v1& message = messages.emplace_back();
    message.key_frame = key_frame ? 1 : 0;
    message.dimension = Dim;
    message.body_count = static_cast<std::int32_t>(here.size());
    message.body.assign(here.begin(), here.end());
    for (const BodyIndex body : here) {
      message.shape.push_back(static_cast<std::int16_t>(states.shape[body]));
      message.asleep.push_back(static_cast<std::int8_t>(states.asleep[body]));
      append<Dim>(states.pose[body], message.poses);
    }
    message.value_count = static_cast<std::int32_t>(message.poses.size());
  } while (!bodies.empty());
  return numbered(std::move(messages));
}

template std::vector<talus_piles_v1> to_piles<2>(std::span<const Pile<2>>);
template std::vector<talus_piles_v1> to_piles<3>(std::span<const Pile<3>>);
template talus_stats_v2 to_stats<2>(const Frame<2>&);
template talus_stats_v2 to_stats<3>(const Frame<3>&);
template std::vector<talus_bodies_v1> to_bodies<2>(const BodyStates<2>&, std::span<const BodyIndex>, bool);
template std::vector<talus_bodies_v1> to_bodies<3>(const BodyStates<3>&, std::span<const BodyIndex>, bool);

}  // namespace talus
