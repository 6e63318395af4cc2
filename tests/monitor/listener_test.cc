// What a network or an enemy between sender and monitor can do: drop, repeat, reorder, cut, and change messages.

#include "tools/monitor/listener.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/wire.h"
#include "tools/monitor/text_view.h"

namespace talus::listener_test {
namespace {

using talus_lcm::talus_run;
using talus_lcm::talus_stats;

/// Hands packets to a listener.
struct Wire {
  Listener listener;

  void send(const Packet& packet) { listener.hear({packet.channel, packet.bytes}); }
  void send(Channel channel, const std::vector<std::uint8_t>& bytes) { listener.hear({channel, bytes}); }
  const RunView& run() const { return listener.runs().entries().at(42).view; }
};

/// A run's messages: TALUS_RUN at both ends, piles, sleep events and statistics of each step between.
std::vector<Packet> stream(int steps) {
  MessageEncoder encoder(42);
  std::vector<Packet> packets;
  const RunInfo info{.scene = "stream", .backend = "box2d", .policy = "paper", .version = "1"};
  constexpr Channel channels[] = {Channel::run, Channel::piles, Channel::sleep, Channel::stats};
  const auto say_run = [&](std::int8_t phase, int step) {
    auto run = to_run(info, phase, "", channels, encoder);
    packets.push_back(encoder.encode(run, {.utime = step, .step = step, .sim_time = 0.1 * step}));
  };
  const Pile<3> pile = in_space(make_pile<2>(Vec2::Zero(), 0.8, 100.0, {}));
  const SleepEvent event{.body = 3, .cause = SleepCause::score};
  say_run(talus_run::BEGIN, 0);
  for (int step = 1; step <= steps; ++step) {
    const Stamp stamp{.utime = step, .step = step, .sim_time = 0.1 * step};
    for (auto& message : to_piles(std::span(&pile, 1))) packets.push_back(encoder.encode(message, stamp));
    for (auto& message : to_sleep(std::span(&event, 1))) packets.push_back(encoder.encode(message, stamp));
    talus_stats stats{};
    stats.awake = step;
    packets.push_back(encoder.encode(stats, stamp));
  }
  say_run(talus_run::END, steps);
  return packets;
}

TEST(Listener, KnowsTheNewestStateAndThatNothingWasLost) {
  Wire wire;
  for (const Packet& packet : stream(50)) wire.send(packet);
  EXPECT_EQ(wire.run().step(), 50);
  EXPECT_EQ(wire.run().stats()->awake, 50);
  EXPECT_EQ(wire.run().reader().slept(), 50);
  EXPECT_TRUE(wire.run().ended());
  EXPECT_EQ(wire.listener.runs().lost(), 0);
  EXPECT_EQ(wire.listener.undecodable(), 0);
}

TEST(Listener, CountsNothingAsLostThatWasSentBeforeItListened) {
  Wire wire;
  const auto packets = stream(50);
  for (std::size_t i = 77; i < packets.size(); ++i) wire.send(packets[i]);
  EXPECT_EQ(wire.listener.runs().lost(), 0);
  EXPECT_EQ(wire.run().run()->scene, "stream");
}

TEST(Listener, CountsARunThatIsPlayedAgainAnew) {
  Wire wire;
  const auto packets = stream(20);
  for (int time = 0; time < 2; ++time)
    for (const Packet& packet : packets) wire.send(packet);
  EXPECT_EQ(wire.run().reader().slept(), 20);
  EXPECT_EQ(wire.listener.runs().lost(), 0);
}

TEST(Listener, ForgetsEndedRunsBeforeItIsFull) {
  Wire wire;
  Packet last;
  for (int id = 0; id < 200; ++id) {
    MessageEncoder encoder(id);
    auto run = to_run({}, talus_run::END, "finished", {}, encoder);
    last = encoder.encode(run, {});
    wire.send(last);
  }
  EXPECT_LE(wire.listener.runs().entries().size(), 64U);
  EXPECT_TRUE(wire.listener.runs().entries().contains(199));
}

RC_GTEST_PROP(ListenerProperty, CountsExactlyWhatWasDropped, ()) {
  Wire wire;
  const auto packets = stream(30);
  std::int64_t dropped = 0;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == packets.size();
    if (!is_end && *rc::gen::inRange(0, 4) == 0)
      ++dropped;
    else
      wire.send(packets[i]);
  }
  RC_ASSERT(wire.listener.runs().lost() == dropped);
}

RC_GTEST_PROP(ListenerProperty, CountsRepeatedAndReorderedMessagesOnce, ()) {
  Wire wire;
  auto packets = stream(30);
  for (std::size_t i = 1; i + 2 < packets.size(); ++i)
    if (*rc::gen::inRange(0, 3) == 0) std::swap(packets[i], packets[i + 1]);
  for (const Packet& packet : packets) {
    wire.send(packet);
    if (*rc::gen::inRange(0, 3) == 0) wire.send(packet);
  }
  RC_ASSERT(wire.listener.runs().lost() == 0);
  RC_ASSERT(wire.run().received() == static_cast<std::int64_t>(packets.size()));
  RC_ASSERT(wire.run().reader().slept() == 30);
  RC_ASSERT(wire.run().stats()->awake == 30);
}

RC_GTEST_PROP(ListenerProperty, RefusesWhatWasCutOrChanged, ()) {
  Wire wire;
  const auto packets = stream(3);
  std::int64_t harmed = 0;
  for (const Packet& packet : packets) {
    auto bytes = packet.bytes;
    const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        bytes.resize(at);
        ++harmed;
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << *rc::gen::inRange(0U, 8U)));
        ++harmed;
        break;
      default:
        break;
    }
    wire.send(packet.channel, bytes);
  }
  RC_ASSERT(wire.listener.undecodable() == harmed);
}

RC_GTEST_PROP(ListenerProperty, SurvivesAnything, (const std::vector<std::uint8_t>& bytes)) {
  Wire wire;
  for (const Channel channel : all_channels) wire.send(channel, bytes);
  RC_ASSERT(wire.listener.undecodable() == static_cast<std::int64_t>(all_channels.size()));
  RC_ASSERT(wire.listener.runs().entries().empty());
}

TEST(Listener, CountsTheLossThatForgedNumbersClaimWithoutOverflow) {
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  Wire wire;
  for (std::int64_t id = 1; id < 200; ++id) {
    for (const std::int64_t number : {std::int64_t{0}, largest}) {
      talus_stats stats{};
      Packet packet = MessageEncoder(id).encode(stats, {});
      for (std::size_t i = 0; i < 8; ++i) packet.bytes[40 + i] = static_cast<std::uint8_t>(number >> (56 - 8 * i));
      const std::uint32_t sum = checksum(std::span(packet.bytes).first(packet.bytes.size() - checksum_bytes));
      for (std::size_t i = 0; i < 4; ++i)
        packet.bytes[packet.bytes.size() - 4 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
      wire.send(packet);
    }
  }
  EXPECT_EQ(wire.listener.undecodable(), 0);
  EXPECT_EQ(wire.listener.runs().lost(), largest);
}

TEST(Listener, KeepsABoundedNumberOfLayers) {
  Wire wire;
  MessageEncoder encoder(42);
  for (int first = 0; first < 200; ++first) {
    talus_lcm::talus_piles message{};
    message.parts = 1;
    message.first_pile = first;
    message.pile_total = 1000;
    message.pile_count = 1;
    message.piles.resize(1);
    message.piles[0].merged_into = -1;
    message.piles[0].layer_count = message.piles[0].layer_total = 1024;
    message.piles[0].layers.resize(1024);
    wire.send(encoder.encode(message, {}));
  }
  EXPECT_EQ(wire.listener.undecodable(), 0) << wire.listener.last_fault();
  EXPECT_EQ(wire.run().piles().size(), 64U);
  EXPECT_EQ(wire.run().reader().piles_left_out(), 136);
}

TEST(DensityBar, HasABlockPerLayerAndGroupsMany) {
  std::vector<Layer> layers(5, {.capacity = 100.0});
  const std::vector<int> counts = {150, 50, 10, 1, 0};
  for (std::size_t i = 0; i < layers.size(); ++i) layers[i].count = counts[i];
  EXPECT_EQ(density_bar(layers), "█▄▁▁ ");
  layers.assign(100, Layer{});
  EXPECT_EQ(density_bar(layers).size(), 24U);  // 24 blanks
  EXPECT_EQ(density_bar({}), "");
}

}  // namespace
}  // namespace talus::listener_test
