#include "lcmtypes/log_reader.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <system_error>

#include "lcmtypes/event_log.h"
#include "lcmtypes/wire.h"
#include "tests/lcmtypes/sample_packets.h"
#include "tests/lcmtypes/scratch_file.h"

namespace talus::log_reader_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A log of sample messages over and over.
const std::vector<Packet>& samples() {
  static const std::vector<Packet> packets = sample_packets<2>(40);
  return packets;
}

Bytes sample_log(int events) {
  const ScratchFile file;
  {
    EventLog log(file.path());
    for (int i = 0; i < events; ++i) {
      Packet packet = samples()[static_cast<std::size_t>(i) % samples().size()];
      packet.utime = 1000 * i;
      log.write(packet);
    }
  }
  return file.read();
}

struct Read {
  std::vector<LogEvent> events;
  LogDamage damage;
  std::size_t undecodable = 0;
};

Read read(const Bytes& bytes) {
  const ScratchFile file;
  file.write(bytes);
  LogReader reader(file.path());
  Read result;
  for (LogEvent event; reader.next(event);) {
    result.events.push_back(event);
    const bool ours = std::count(channel_names.begin(), channel_names.end(), event.channel) == 1;
    if (ours && !checksum_holds(event.data)) ++result.undecodable;
  }
  result.damage = reader.damage();
  return result;
}

std::size_t size_of_event(int number) {
  const Packet& packet = samples()[static_cast<std::size_t>(number) % samples().size()];
  return 28 + std::string(name_of(packet.channel)).size() + packet.bytes.size();
}

TEST(EventLog, IsReadBackByOurReaderAndByThatOfLcm) {
  const ScratchFile file;
  file.write(sample_log(100));
  LogReader ours(file.path());
  lcm::LogFile theirs(file.path(), "r");
  LogEvent event;
  for (int i = 0; i < 100; ++i) {
    const Packet& packet = samples()[static_cast<std::size_t>(i) % samples().size()];
    ASSERT_TRUE(ours.next(event));
    const lcm::LogEvent* same = theirs.readNextEvent();
    ASSERT_NE(same, nullptr);
    EXPECT_EQ(event.number, i);
    EXPECT_EQ(event.timestamp, 1000 * i);
    EXPECT_EQ(event.channel, name_of(packet.channel));
    EXPECT_EQ(event.data, packet.bytes);
    EXPECT_EQ(same->timestamp, 1000 * i);
    EXPECT_EQ(same->datalen, static_cast<int>(packet.bytes.size()));
  }
  EXPECT_FALSE(ours.next(event));
  EXPECT_EQ(theirs.readNextEvent(), nullptr);
  EXPECT_EQ(ours.damage().bytes, 0U);
}

TEST(EventLog, SaysWhichFileItCannotMakeOrFill) {
  EXPECT_THROW(EventLog("/no/such/folder/run.lcm"), std::system_error);
  EventLog full("/dev/full");
  Packet packet = samples().front();
  full.write(packet);
  EXPECT_THROW(full.flush(), std::system_error);
  EXPECT_NO_THROW(full.write(packet));  // has said so once
}

TEST(LogReader, SaysWhichFileIsMissing) { EXPECT_THROW(LogReader("/no/such/file"), std::system_error); }

TEST(LogReader, ReadsUpToACut) {
  Bytes bytes = sample_log(50);
  bytes.erase(bytes.end() - 10, bytes.end());
  const Read result = read(bytes);
  EXPECT_EQ(result.events.size(), 49U);
  EXPECT_EQ(result.damage.places, 1U);
  EXPECT_EQ(result.damage.bytes, size_of_event(49) - 10);
}

// Lengths that stop the reader of LCM 1.3.1 or, at 2^31 - 1, make it crash.
TEST(LogReader, SkipsEventsWithImpossibleLengths) {
  for (const std::size_t field : {20U, 24U}) {
    for (const std::uint8_t highest : {std::uint8_t{0x7F}, std::uint8_t{0x80}, std::uint8_t{0xFF}, std::uint8_t{0}}) {
      Bytes bytes = sample_log(50);
      bytes[field] = highest;
      for (std::size_t i = 1; i < 4; ++i) bytes[field + i] = 0xFF;
      const Read result = read(bytes);
      EXPECT_EQ(result.events.size(), 49U);
      EXPECT_EQ(result.damage.places, 1U);
      EXPECT_EQ(result.damage.bytes, size_of_event(0));
    }
  }
}

TEST(LogReader, LosesOneEventAtMostToAFlippedBit) {
  const Bytes whole = sample_log(12);
  for (std::size_t bit = 0; bit < whole.size() * 8;
       bit += 61) {  // 61: hits every kind of field, and every bit of a byte
    Bytes bytes = whole;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << bit % 8));
    const Read result = read(bytes);
    ASSERT_GE(result.events.size(), 11U) << "bit " << bit;
    ASSERT_EQ(result.events.size() == 11U, result.damage.bytes > 0) << "bit " << bit;
  }
}

TEST(LogReader, FindsTheWayBackAfterALostStretch) {
  Bytes bytes = sample_log(50);
  bytes.erase(bytes.begin() + 100, bytes.begin() + 3000);
  const Read result = read(bytes);
  EXPECT_EQ(result.damage.places, 1U);
  EXPECT_EQ(result.events.back().number, 49);
}

TEST(LogReader, PassesOverChannelsThatAreNotOurs) {
  const ScratchFile file;
  {
    lcm::LogFile log(file.path(), "w");
    char text[] = "of another log";
    for (int i = 0; i < 3; ++i) {
      lcm::LogEvent event{};
      event.channel = "OTHER";
      event.datalen = sizeof text;
      event.data = text;
      log.writeEvent(&event);
    }
  }
  LogReader reader(file.path());
  LogEvent event;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(reader.next(event));
    EXPECT_EQ(event.channel, "OTHER");
  }
  EXPECT_FALSE(reader.next(event));
  EXPECT_EQ(reader.damage().bytes, 0U);
}

RC_GTEST_PROP(LogReaderProperty, SurvivesAnyFile, (const Bytes& bytes)) {
  const Read result = read(bytes);
  RC_ASSERT(result.undecodable == 0U);
  if (result.events.empty()) RC_ASSERT(result.damage.bytes == bytes.size());
}

RC_GTEST_PROP(LogReaderProperty, NeverPassesOnWhatAChecksumRefuses, ()) {
  static const Bytes whole = sample_log(30);
  Bytes bytes = whole;
  const auto changes = *rc::gen::inRange(1, 20);
  for (int i = 0; i < changes; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    const auto length = std::min<std::ptrdiff_t>(*rc::gen::inRange(0, 300), std::ssize(bytes) - at);
    switch (*rc::gen::inRange(0, 3)) {
      case 0:  // lost
        bytes.erase(bytes.begin() + at, bytes.begin() + at + length);
        break;
      case 1:  // twice
      {
        const Bytes copy(bytes.begin() + at, bytes.begin() + at + length);
        bytes.insert(bytes.begin() + at, copy.begin(), copy.end());
        break;
      }
      default:  // overwritten
        std::fill(bytes.begin() + at, bytes.begin() + at + length, *rc::gen::arbitrary<std::uint8_t>());
    }
  }
  std::size_t kept = 0;
  const Read result = read(bytes);
  for (const LogEvent& event : result.events) kept += 28 + event.channel.size() + event.data.size();
  RC_ASSERT(result.undecodable == 0U);
  RC_ASSERT(kept + result.damage.bytes == bytes.size());  // every byte is accounted for
}

}  // namespace
}  // namespace talus::log_reader_test
