#pragma once

#include <cstdint>
#include <span>

namespace talus {

/// CRC-32 as in zlib, gzip and PNG (polynomial 0x04C11DB7 reflected): of "123456789" it is 0xCBF43926.
std::uint32_t crc32(std::span<const std::uint8_t> bytes);

}  // namespace talus
