#include "tools/view/stream_numbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace talus {

void write_unsigned(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>((value & 0x7F) | 0x80);
  bytes += static_cast<char>(value);
}

void write_signed(std::string& bytes, std::int64_t value) {
  write_unsigned(bytes, (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
}

void write_float(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xFF);
}

std::uint64_t StreamReader::number() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) break;
  }
  return value;
}

std::int64_t StreamReader::difference() {
  const std::uint64_t value = number();
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

float StreamReader::real() {
  std::uint32_t bits = 0;
  for (int shift = 0; shift < 32; shift += 8)
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_.at(at_++))) << shift;
  return std::bit_cast<float>(bits);
}

std::string StreamReader::text(std::size_t size) {
  if (size > bytes_.size() - at_) throw std::out_of_range("the bytes end within a text");
  at_ += size;
  return std::string(bytes_.substr(at_ - size, size));
}

std::int32_t in_quanta(double value, double quantum) {
  constexpr double limit = 1 << 30;
  return static_cast<std::int32_t>(std::lround(std::clamp(value / quantum, -limit, limit)));
}

}  // namespace talus
