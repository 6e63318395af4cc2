#include "lcmtypes/crc32.h"

#include <array>
#include <cstddef>

namespace talus {
namespace {

using Table = std::array<std::array<std::uint32_t, 256>, 8>;

/// Entry [n][b]: what byte b does to the remainder when n more zero bytes follow it.
constexpr Table make_table() {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    table[0][byte] = remainder;
  }
  for (std::size_t n = 1; n < table.size(); ++n) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = table[n - 1][byte];
      table[n][byte] = (before >> 8) ^ table[0][before & 0xFFU];
    }
  }
  return table;
}

constexpr Table table = make_table();

std::uint32_t word(std::span<const std::uint8_t> bytes) {
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8 | static_cast<std::uint32_t>(bytes[2]) << 16 |
         static_cast<std::uint32_t>(bytes[3]) << 24;
}

}  // namespace

// Eight bytes at a time ("slicing by 8", Kounavis and Berry 2005): the record's body frames are large, and the
// simulation pays for them.
std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t remainder = 0xFFFFFFFFU;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    const std::uint32_t low = remainder ^ word(bytes);
    const std::uint32_t high = word(bytes.subspan(4));
    remainder = table[7][low & 0xFFU] ^ table[6][low >> 8 & 0xFFU] ^ table[5][low >> 16 & 0xFFU] ^ table[4][low >> 24] ^
                table[3][high & 0xFFU] ^ table[2][high >> 8 & 0xFFU] ^ table[1][high >> 16 & 0xFFU] ^
                table[0][high >> 24];
  }
  for (const std::uint8_t byte : bytes) {
    remainder = (remainder >> 8) ^ table[0][(remainder ^ byte) & 0xFFU];
  }
  return ~remainder;
}

}  // namespace talus
