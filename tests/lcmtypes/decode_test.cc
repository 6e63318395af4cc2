#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/sample_packets.h"

namespace talus::decode_test {
namespace {

using talus_lcm::talus_bodies;
using talus_lcm::talus_piles;
using talus_lcm::talus_run;
using talus_lcm::talus_shapes;
using talus_lcm::talus_sleep;
using talus_lcm::talus_stats;
using Bytes = std::vector<std::uint8_t>;

template <class Message>
std::string fault_of(std::span<const std::uint8_t> bytes) {
  Message message;
  return std::string(decode(bytes, message));
}

std::string fault_of(Channel channel, std::span<const std::uint8_t> bytes) {
  std::string fault;
  with_message_of(channel, [&]<class Message>(const Message&) { fault = fault_of<Message>(bytes); });
  return fault;
}

/// A packet with the right checksum, whatever the rest is.
void seal_again(Bytes& bytes) {
  const std::uint32_t sum = checksum(std::span(bytes).first(bytes.size() - checksum_bytes));
  for (std::size_t i = 0; i < checksum_bytes; ++i)
    bytes[bytes.size() - 1 - i] = static_cast<std::uint8_t>(sum >> (8 * i));
}

template <int Dim>
std::vector<Packet>& samples() {
  static std::vector<Packet> packets = sample_packets<Dim>(20);
  return packets;
}

TEST(Decoder, AcceptsWhatWeSend) {
  for (const Packet& packet : sample_packets<2>(20)) EXPECT_EQ(fault_of(packet.channel, packet.bytes), "");
  for (const Packet& packet : sample_packets<3>(20)) EXPECT_EQ(fault_of(packet.channel, packet.bytes), "");
}

TEST(Decoder, RefusesEveryTruncation) {
  for (const Packet& packet : samples<3>()) {
    for (std::size_t size = 0; size < packet.bytes.size(); ++size) {
      Bytes cut(packet.bytes.begin(), packet.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_NE(fault_of(packet.channel, cut), "") << name_of(packet.channel) << " cut to " << size;
      if (size < checksum_bytes) continue;
      seal_again(cut);
      ASSERT_NE(fault_of(packet.channel, cut), "") << name_of(packet.channel) << " cut to " << size << ", sealed";
    }
  }
}

TEST(Decoder, RefusesEveryFlippedBit) {
  for (const Packet& packet : samples<2>()) {
    for (std::size_t bit = 0; bit < packet.bytes.size() * 8; ++bit) {
      Bytes flipped = packet.bytes;
      flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << bit % 8));
      ASSERT_NE(fault_of(packet.channel, flipped), "") << name_of(packet.channel) << " bit " << bit;
    }
  }
}

TEST(Decoder, RefusesBytesThatFollow) {
  for (const Packet& packet : samples<2>()) {
    Bytes longer = packet.bytes;
    longer.push_back(0);
    seal_again(longer);
    EXPECT_NE(fault_of(packet.channel, longer), "");
  }
}

TEST(Decoder, RefusesAnotherType) {
  for (const Packet& packet : samples<2>())
    if (packet.channel != Channel::piles) EXPECT_EQ(fault_of<talus_piles>(packet.bytes), "another type or version");
}

TEST(Decoder, AcceptsEachCauseOfASleepEventAndNoOther) {
  MessageEncoder encoder(1);
  for (int cause = 0; cause <= last_cause; ++cause) {
    talus_sleep message = to_sleep(std::vector<SleepEvent>{{.cause = static_cast<SleepCause>(cause)}}).front();
    EXPECT_EQ(fault_of<talus_sleep>(encoder.encode(message, {0, 1, 0.5}).bytes), "") << cause;
  }
  talus_sleep message = to_sleep(std::vector<SleepEvent>(1)).front();
  message.cause[0] = last_cause + 1;
  EXPECT_EQ(fault_of<talus_sleep>(encoder.encode(message, {0, 1, 0.5}).bytes), "unknown cause");
}

// Debian's generated decoder would resize to 2^31 - 1 entries first and look at the bytes left afterwards.
TEST(Decoder, RefusesHugeAndNegativeCountsWithoutAllocating) {
  for (const Packet& packet : samples<3>()) {
    for (std::size_t at = header_bytes; at + 4 + checksum_bytes <= packet.bytes.size(); ++at) {
      for (const std::uint8_t highest : {std::uint8_t{0x7F}, std::uint8_t{0x80}}) {
        Bytes wrong = packet.bytes;
        wrong[at] = highest;
        for (std::size_t i = 1; i < 4; ++i) wrong[at + i] = 0xFF;
        seal_again(wrong);
        fault_of(packet.channel, wrong);  // may be a plain value; must neither crash nor eat the memory
      }
    }
  }
}

TEST(Decoder, RefusesWhatIsNotFinite) {
  talus_piles piles = to_piles({}).front();
  MessageEncoder encoder(1);
  EXPECT_EQ(fault_of<talus_piles>(encoder.encode(piles, {0, 1, 0.5}).bytes), "");
  EXPECT_NE(fault_of<talus_piles>(encoder.encode(piles, {0, 1, std::nan("")}).bytes), "");
  EXPECT_NE(fault_of<talus_piles>(encoder.encode(piles, {0, -1, 0.5}).bytes), "");
  talus_stats stats{};
  stats.kinetic_energy = std::numeric_limits<double>::infinity();
  EXPECT_NE(fault_of<talus_stats>(encoder.encode(stats, {0, 1, 0.5}).bytes), "");
}

/// The number stands at the same place in every format.
void set_format(Bytes& bytes, std::int32_t format) {
  for (std::size_t i = 0; i < 4; ++i) bytes[header_bytes + i] = static_cast<std::uint8_t>(format >> (8 * (3 - i)));
  seal_again(bytes);
}

TEST(Decoder, NamesTheFormatAndVersionOfARunOfAnotherFormat) {
  Bytes bytes = samples<2>().front().bytes;
  EXPECT_FALSE(other_format(bytes)) << "of this format";
  set_format(bytes, 7);
  EXPECT_EQ(fault_of<talus_run>(bytes), "another format");
  ASSERT_TRUE(other_format(bytes));
  EXPECT_EQ(other_format(bytes)->format, 7);
  EXPECT_EQ(other_format(bytes)->version, run_info(still_scene<2>(), "", "").version);
  bytes[0] ^= 1U;  // fields after the version differ, and with them the fingerprint
  seal_again(bytes);
  EXPECT_EQ(fault_of<talus_run>(bytes), "another type or version");
  EXPECT_EQ(other_format(bytes)->format, 7);
  bytes.back() ^= 1U;
  EXPECT_FALSE(other_format(bytes)) << "damaged";
}

TEST(Decoder, SurvivesAVersionOfAnyLengthInARunOfAnotherFormat) {
  for (const std::uint32_t length : {0U, 1U, 2U, 200U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    Bytes bytes = samples<2>().front().bytes;
    for (std::size_t i = 0; i < 4; ++i)
      bytes[header_bytes + 4 + i] = static_cast<std::uint8_t>(length >> (8 * (3 - i)));
    set_format(bytes, 7);
    ASSERT_TRUE(other_format(bytes));
    EXPECT_LT(other_format(bytes)->version.size(), bytes.size());
  }
}

TEST(Decoder, RefusesObstaclesThatNoRunGives) {
  MessageEncoder encoder(1);
  const auto fault = [&](int dimension, std::vector<std::int32_t> obstacles, std::size_t values) {
    talus_lcm::talus_obstacles message{};
    message.dimension = dimension;
    message.obstacle_count = static_cast<std::int32_t>(obstacles.size());
    message.obstacle = std::move(obstacles);
    message.value_count = static_cast<std::int32_t>(values);
    message.poses.assign(values, 0.5F);
    return fault_of<talus_lcm::talus_obstacles>(encoder.encode(message, {0, 1, 0.5}).bytes);
  };
  EXPECT_EQ(fault(2, {0, 5}, 6), "");
  EXPECT_EQ(fault(3, {0, 5}, 14), "");
  EXPECT_NE(fault(4, {0, 5}, 6), "");
  EXPECT_NE(fault(2, {0, 5}, 5), "");
  EXPECT_NE(fault(2, {5, 5}, 6), "");
  EXPECT_NE(fault(2, {-1, 5}, 6), "");
}

TEST(Decoder, RefusesContactsThatNoRunGives) {
  MessageEncoder encoder(1);
  const auto fault = [&](std::int32_t body, std::size_t values) {
    talus_lcm::talus_contacts message{};
    message.parts = message.contact_count = 1;
    message.a = {body};
    message.b = {-3};
    message.kept = {1};
    message.value_count = static_cast<std::int32_t>(values);
    message.values.assign(values, 0.5F);
    return fault_of<talus_lcm::talus_contacts>(encoder.encode(message, {0, 1, 0.5}).bytes);
  };
  EXPECT_EQ(fault(4, 9), "");
  EXPECT_NE(fault(-1, 9), "");
  EXPECT_NE(fault(4, 8), "");
}

TEST(Decoder, RefusesInstrumentsThatNoRunGives) {
  MessageEncoder encoder(1);
  const auto fault = [&](std::int64_t passed, std::int8_t kind, std::int32_t obstacle, std::size_t values) {
    talus_lcm::talus_instruments message{};
    message.parts = 1;
    message.gates.resize(1);
    message.gates[0].forward = passed;
    message.gates[0].outline.assign(values, 0.5F);
    message.gates[0].value_count = static_cast<std::int32_t>(values);
    message.regions.resize(1);
    message.regions[0].kind = kind;
    message.loads.resize(1);
    message.loads[0].obstacle = {obstacle};
    message.loads[0].obstacle_count = message.gate_count = message.region_count = message.load_count = 1;
    return fault_of<talus_lcm::talus_instruments>(encoder.encode(message, {0, 1, 0.5}).bytes);
  };
  EXPECT_EQ(fault(3, 0, -1, 6), "");
  EXPECT_NE(fault(-1, 0, -1, 6), "");
  EXPECT_NE(fault(3, 3, -1, 6), "");
  EXPECT_NE(fault(3, 0, -2, 6), "");
  EXPECT_NE(fault(3, 0, -1, 5), "");
}

TEST(Decoder, RefusesWarningsThatNoRunGives) {
  MessageEncoder encoder(1);
  const auto fault = [&](std::int8_t kind, std::int64_t step, double value, std::size_t number) {
    talus_stats stats{};
    stats.warning_count = static_cast<std::int32_t>(number);
    stats.warning_kind.assign(number, kind);
    stats.warning_step.assign(number, step);
    stats.warning_body.assign(number, 0);
    stats.warning_bodies.assign(number, 1);
    stats.warning_value.assign(number, value);
    stats.warning_text.assign(number, "");
    return fault_of<talus_stats>(encoder.encode(stats, {0, 1, 0.5}).bytes);
  };
  EXPECT_EQ(fault(talus_stats::PASSED, 1, 1.0, 8), "");
  EXPECT_NE(fault(talus_stats::PASSED + 1, 1, 1.0, 1), "");
  EXPECT_NE(fault(-1, 1, 1.0, 1), "");
  EXPECT_NE(fault(0, -1, 1.0, 1), "");
  EXPECT_NE(fault(0, 1, std::nan(""), 1), "");
  EXPECT_NE(fault(0, 1, 1.0, 9), "");
}

RC_GTEST_PROP(DecoderProperty, SurvivesAnything, (Bytes bytes, bool sealed)) {
  if (sealed && bytes.size() >= checksum_bytes) seal_again(bytes);
  for (const Packet& packet : samples<2>()) RC_ASSERT(!fault_of(packet.channel, bytes).empty());
}

RC_GTEST_PROP(DecoderProperty, SurvivesSealedMessagesWithRandomBytesIn, ()) {
  const Packet& packet = *rc::gen::elementOf(samples<3>());
  Bytes bytes = packet.bytes;
  const auto changes = *rc::gen::inRange(1, 8);
  for (int i = 0; i < changes; ++i)
    bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<std::uint8_t>();
  seal_again(bytes);
  fault_of(packet.channel, bytes);  // may be accepted where only a value changed within its range
}

}  // namespace
}  // namespace talus::decode_test
