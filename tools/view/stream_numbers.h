#pragma once
// Numbers in the bytes that the browser page reads.

#include <cstdint>
#include <string>

namespace talus {

/// `u` of FrameEncoder: seven bits a byte, low bits first.
void write_unsigned(std::string& bytes, std::uint64_t value);
/// `s`: zigzag over `u`.
void write_signed(std::string& bytes, std::int64_t value);
/// `f`: four bytes, low byte first.
void write_float(std::string& bytes, float value);

/// The nearest whole number of quanta; at most 2^30 in size.
std::int32_t in_quanta(double value, double quantum);

}  // namespace talus
