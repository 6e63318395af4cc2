#include "lcmtypes/layout.h"

#include <gtest/gtest.h>

#include <bit>

#include "tests/lcmtypes/sample_packets.h"

namespace talus::layout_test {
namespace {

using talus_lcm::talus_bodies;
using talus_lcm::talus_run;
using talus_lcm::talus_sleep;

/// Puts the bits of a field with one entry, at `offset` bytes after the fingerprint.
template <class Bits>
void put(std::vector<std::uint8_t>& bytes, std::size_t offset, Bits bits) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i)
    bytes[fingerprint_bytes + offset + i] = static_cast<std::uint8_t>(bits >> (8 * (sizeof(Bits) - 1 - i)));
}

template <class Message>
std::string fault_of(const std::vector<std::uint8_t>& bytes) {
  return std::string(layout_fault(layout<Message>, bytes));
}

std::vector<std::uint8_t> sleep_message(std::size_t events) {
  talus_sleep message = to_sleep(std::vector<SleepEvent>(events)).front();
  return MessageEncoder(1).encode(message, {}).bytes;
}

// One event more makes the message longer by 3 * 4 + 2 * 1 + 4 bytes, as the .lcm file says.
TEST(MessageLayout, GivesTheSizeOfOneMoreEntry) {
  EXPECT_EQ(bytes_per_entry(layout<talus_sleep>, "event_count"), 18U);
  EXPECT_EQ(sleep_message(3).size(), sleep_message(2).size() + 18);
}

TEST(MessageLayout, GivesTheSizeOfTheFixedFields) {
  EXPECT_EQ(fingerprint_bytes + fixed_bytes(layout<talus_sleep>), sleep_message(2).size() - 2 * 18);
}

TEST(MessageLayout, RefusesACountBeyondTheBytesLeft) {
  std::vector<std::uint8_t> bytes = sleep_message(2);
  EXPECT_EQ(fault_of<talus_sleep>(bytes), "");
  const std::size_t event_count = 5 * 8 + 2 * 4;  // after the header and the numbers of the part
  for (const std::uint32_t count : {100U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    put(bytes, event_count, count);
    EXPECT_EQ(fault_of<talus_sleep>(bytes), "counts do not match the size") << count;
  }
}

TEST(MessageLayout, RefusesANumberThatIsNotFinite) {
  std::vector<std::uint8_t> bytes = sleep_message(1);
  const std::size_t sim_time = 3 * 8;
  for (const double value : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    put(bytes, sim_time, std::bit_cast<std::uint64_t>(value));
    EXPECT_EQ(fault_of<talus_sleep>(bytes), "a number is not finite");
  }
}

TEST(MessageLayout, RefusesABooleanThatIsNeither0Nor1) {
  talus_bodies message{};
  std::vector<std::uint8_t> bytes = MessageEncoder(1).encode(message, {}).bytes;
  const std::size_t key_frame = 5 * 8;
  put(bytes, key_frame, std::uint8_t{2});
  EXPECT_EQ(fault_of<talus_bodies>(bytes), "a boolean is neither 0 nor 1");
}

TEST(MessageLayout, RefusesATextWithoutItsEnd) {
  talus_run message{};
  std::vector<std::uint8_t> bytes = MessageEncoder(1).encode(message, {}).bytes;
  const std::size_t version = 5 * 8 + 4;
  put(bytes, version + 4, std::uint8_t{'x'});
  EXPECT_EQ(fault_of<talus_run>(bytes), "counts do not match the size");
}

TEST(MessageChecksum, IsThatOfZlib) {
  const std::string text = "123456789";
  EXPECT_EQ(checksum(std::vector<std::uint8_t>(text.begin(), text.end())), 0xCBF43926U);
}

}  // namespace
}  // namespace talus::layout_test
