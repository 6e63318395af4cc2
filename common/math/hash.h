#pragma once

#include <cstdint>
#include <string_view>

namespace talus {

/// FNV-1a of bytes, in 64 bits: the same on each machine, so that hashes may be written down.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) add_byte(static_cast<unsigned char>(byte));
  }
  /// Eight bytes, the lowest first.
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) add_byte((word >> shift) & 0xffU);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001b3U; }

  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace talus
