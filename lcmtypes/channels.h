#pragma once
// The channels, their message types, and the largest size of a message.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "talus_lcm/layouts.h"

namespace talus {

/// One kind of message each.
enum class Channel : std::uint8_t {
  run,
  piles,
  sleep,
  stats,
  bodies,
  shapes,
  events,
  obstacles,
  scene,
  instruments,
  contacts
};

inline constexpr std::array<const char*, 11> channel_names = {
    "TALUS_RUN",    "TALUS_PILES",     "TALUS_SLEEP", "TALUS_STATS",       "TALUS_BODIES",  "TALUS_SHAPES",
    "TALUS_EVENTS", "TALUS_OBSTACLES", "TALUS_SCENE", "TALUS_INSTRUMENTS", "TALUS_CONTACTS"};

/// Of each name.
inline constexpr std::string_view channel_prefix = "TALUS_";

inline constexpr const char* name_of(Channel channel) { return channel_names[static_cast<std::size_t>(channel)]; }

inline constexpr auto all_channels = [] {
  std::array<Channel, channel_names.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Channel>(i);
  return all;
}();

inline std::optional<Channel> channel_named(std::string_view name) {
  const auto found = std::find(channel_names.begin(), channel_names.end(), name);
  if (found == channel_names.end()) return std::nullopt;
  return static_cast<Channel>(found - channel_names.begin());
}

template <class Message>
inline constexpr Channel channel_of = Channel::run;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_piles> = Channel::piles;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_sleep> = Channel::sleep;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_stats> = Channel::stats;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_bodies> = Channel::bodies;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_shapes> = Channel::shapes;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_event> = Channel::events;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_obstacles> = Channel::obstacles;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_scene> = Channel::scene;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_instruments> = Channel::instruments;
template <>
inline constexpr Channel channel_of<talus_lcm::talus_contacts> = Channel::contacts;

/// Calls `use` with a default message of the type that the channel carries.
template <class Use>
void with_message_of(Channel channel, const Use& use) {
  switch (channel) {
    case Channel::run:
      return use(talus_lcm::talus_run{});
    case Channel::piles:
      return use(talus_lcm::talus_piles{});
    case Channel::sleep:
      return use(talus_lcm::talus_sleep{});
    case Channel::stats:
      return use(talus_lcm::talus_stats{});
    case Channel::bodies:
      return use(talus_lcm::talus_bodies{});
    case Channel::shapes:
      return use(talus_lcm::talus_shapes{});
    case Channel::events:
      return use(talus_lcm::talus_event{});
    case Channel::obstacles:
      return use(talus_lcm::talus_obstacles{});
    case Channel::scene:
      return use(talus_lcm::talus_scene{});
    case Channel::instruments:
      return use(talus_lcm::talus_instruments{});
    case Channel::contacts:
      return use(talus_lcm::talus_contacts{});
  }
}

/// The channels that each run sends and records on.
inline constexpr std::array usual_channels = {Channel::run,   Channel::piles,  Channel::sleep,
                                              Channel::stats, Channel::bodies, Channel::shapes};

/// Largest encoded message [bytes]: what fits one datagram, since LCM 1.3.1 loses every message of several fragments
/// when one of them is lost or late.
inline constexpr std::size_t max_message_bytes = 60'000;

/// Encoded size of what starts every message [bytes]: fingerprint, then utime, run_id, step, sim_time, seq.
inline constexpr std::size_t header_bytes = fingerprint_bytes + 5 * 8;
/// Encoded size of the checksum that ends it.
inline constexpr std::size_t checksum_bytes = 4;

/// Most layers that talus_pile carries of one pile.
inline constexpr std::size_t max_layers = 1024;

}  // namespace talus
