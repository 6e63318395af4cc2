#pragma once
// Numbers as LCM writes them.

#include <cstdint>
#include <span>

namespace talus {

/// The unsigned number that up to eight bytes hold, the most significant one first.
inline std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

}  // namespace talus
