#pragma once
// The channels, their message types, and the largest size of a message.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

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

/// What each channel carries, in their order.
using ChannelMessages =
    std::tuple<talus_lcm::talus_run, talus_lcm::talus_piles, talus_lcm::talus_sleep, talus_lcm::talus_stats,
               talus_lcm::talus_bodies, talus_lcm::talus_shapes, talus_lcm::talus_event, talus_lcm::talus_obstacles,
               talus_lcm::talus_scene, talus_lcm::talus_instruments, talus_lcm::talus_contacts>;
static_assert(std::tuple_size_v<ChannelMessages> == channel_names.size());

template <class Message>
inline constexpr Channel channel_of = []<class... Each>(const std::tuple<Each...>*) {
  constexpr std::array same = {std::is_same_v<Message, Each>...};
  constexpr auto place = std::find(same.begin(), same.end(), true) - same.begin();
  static_assert(place < std::ssize(same), "carried by no channel");
  return static_cast<Channel>(place);
}(static_cast<const ChannelMessages*>(nullptr));

/// Calls `use` with a default message of the type that the channel carries.
template <class Use>
void with_message_of(Channel channel, const Use& use) {
  [&]<class... Each>(const std::tuple<Each...>*) {
    ((channel == channel_of<Each> ? use(Each{}) : void()), ...);
  }(static_cast<const ChannelMessages*>(nullptr));
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
