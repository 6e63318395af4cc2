#include "lcmtypes/crc32.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string_view>
#include <vector>

namespace talus::crc32_test {
namespace {

std::uint32_t of_text(std::string_view text) { return crc32(std::vector<std::uint8_t>(text.begin(), text.end())); }

TEST(Crc32, GivesThePublishedValues) {
  EXPECT_EQ(of_text(""), 0U);
  EXPECT_EQ(of_text("123456789"), 0xCBF43926U);
  EXPECT_EQ(of_text("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
}

RC_GTEST_PROP(Crc32, SeesEveryFlippedBit, (std::vector<std::uint8_t> bytes)) {
  RC_PRE(!bytes.empty());
  const std::uint32_t before = crc32(bytes);
  const auto bit = *rc::gen::inRange<std::size_t>(0, bytes.size() * 8);
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << bit % 8));
  RC_ASSERT(crc32(bytes) != before);
}

}  // namespace
}  // namespace talus::crc32_test
