#pragma once
// Numbers as the browser page reads them, from their description in tools/view/frame_stream.h.

#include <bit>
#include <cstdint>
#include <string>

namespace talus {

class StreamReader {
 public:
  explicit StreamReader(const std::string& bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
      value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
  }

  std::int64_t difference() {
    const std::uint64_t value = number();
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }

  float real() {
    std::uint32_t bits = 0;
    for (int shift = 0; shift < 32; shift += 8)
      bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_.at(at_++))) << shift;
    return std::bit_cast<float>(bits);
  }

  std::string text(std::size_t size) {
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }

  bool done() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace talus
